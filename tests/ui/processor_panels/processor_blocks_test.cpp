// What the diagram of the processor tells of transfers over the bus.
#include "ui/processor_panels/processor_blocks.h"

#include "core/cordic/assembler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

namespace millwright::panels {
namespace {

using cordic::Processor;
using testing::Contains;
using testing::Each;
using testing::Not;
using testing::StartsWith;

Processor loaded(const char* text) {
    const cordic::Assembled made = cordic::assemble(text, "a.asm");
    EXPECT_TRUE(made.errors.empty());
    return {{}, made.image};
}

TEST(ProcessorBlocks, ShowWhatLdAndStMoveOverTheBus) {
    Processor processor = loaded("LD XI, 0x8004\nST XI, 0x8010\nHLT\n");
    const std::vector<std::uint8_t> two{0x00, 0x00, 0x00, 0x40}; // in binary32, at 0x8004
    std::ranges::copy(two, processor.memory().ram.begin() + 4);
    EXPECT_THAT(lines_of(ProcessorBlock::ram, processor), Each(Not(StartsWith("byte"))));
    processor.run_instruction(1000);
    EXPECT_EQ(processor.number(processor.state().registers[0]), 2.0);
    EXPECT_THAT(lines_of(ProcessorBlock::ram, processor), Contains("byte 40"));
    EXPECT_THAT(lines_of(ProcessorBlock::ram, processor), Contains("at 8007"));
    EXPECT_THAT(lines_of(ProcessorBlock::rom, processor), Each(Not(StartsWith("byte"))));
    bool lit_ram = false;
    bool lit_registers = false;
    while (processor.memory().ram[0x13] != two[3] && processor.state().stop == cordic::Stop::none) {
        processor.clock();
        lit_ram = lit_ram || lights(ProcessorBlock::ram, processor.state());
        lit_registers = lit_registers || lights(ProcessorBlock::registers, processor.state());
    }
    EXPECT_TRUE(lit_ram);
    EXPECT_TRUE(lit_registers);
    EXPECT_THAT(lines_of(ProcessorBlock::ram, processor), Contains("at 8013"));
}

} // namespace
} // namespace millwright::panels
