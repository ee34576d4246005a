// LD and ST: the dual-port RAM between the processor and its host, over the bus with RD and WR.
#include "core/cordic/assembler.h"
#include "core/cordic/processor.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

Image image_of(const std::string& text, const NumberFormat& format = binary32) {
    Assembled made = assemble(text, "memory.asm", format);
    EXPECT_TRUE(made.errors.empty()) << (made.errors.empty() ? "" : made.errors[0].message);
    return made.image;
}

double value_of(const Processor& processor, Register name) {
    return processor.number(register_of(processor.state(), name));
}

TEST(DualPortRam, CarriesNumbersFromTheHostAndBack) {
    for (const NumberFormat& format : {binary64, binary32, fixed_format(6, 10), fixed_format(10, 40)}) {
        Processor processor(
            {}, image_of("MOV X0, -2.5\nST X0, 0x8010\nLD Y0, 0x8010\nLD Z0, 0x8100\nHLT\n", format));
        const auto host = with_arithmetic(format, [](const auto& arithmetic) {
            bool overflow = false;
            return arithmetic.to_word(arithmetic.from_double(-7.75, overflow));
        });
        std::vector<std::uint8_t>& ram = processor.memory().ram;
        for (std::size_t n = 0; n < 8; ++n) {
            ram[0x100 + n] = static_cast<std::uint8_t>(host >> (8 * n));
        }
        processor.run(1'000);
        EXPECT_EQ(processor.state().stop, Stop::halted);
        EXPECT_EQ(value_of(processor, Register::Y0), -2.5);
        EXPECT_EQ(value_of(processor, Register::Z0), -7.75);
        const Word x0 = register_of(processor.state(), Register::X0);
        for (int n = 0; n < immediate_bytes(format); ++n) {
            EXPECT_EQ(ram[static_cast<std::size_t>(0x10 + n)], static_cast<std::uint8_t>(x0 >> (8 * n)));
        }
        EXPECT_EQ(ram[static_cast<std::size_t>(0x10 + immediate_bytes(format))], 0xff); // as it was
    }
}

// Thesis section 2.6: ALE with the address, then RD or WR with the data, never two strobes.
TEST(DualPortRam, IsReadWithRdAndWrittenWithWrInTheOrderOfTheBus) {
    for (const int waits : {0, 2}) {
        Processor processor({.wait_states = waits},
                            image_of("MOV N, 0x04030201\nST N, 0x9000\nLD P, 0x9000\nHLT\n"));
        int reads = 0;
        int writes = 0;
        BusPins before;
        while (processor.state().stop == Stop::none) {
            processor.clock();
            const BusPins pins = processor.state().bus.pins;
            EXPECT_LE(static_cast<int>(pins.ale) + pins.psen + pins.rd + pins.wr, 1);
            const bool begins = (pins.rd && !before.rd) || (pins.wr && !before.wr);
            if (begins) {
                EXPECT_TRUE(before.ale);
                EXPECT_EQ(before.address, pins.address);
                EXPECT_EQ(before.data, pins.address & 0xff);
                EXPECT_EQ(pins.address, 0x9000 + (pins.rd ? reads : writes) % 4);
                (pins.rd ? reads : writes) += 1;
            }
            before = pins;
        }
        EXPECT_EQ(reads, 4);
        EXPECT_EQ(writes, 4);
        EXPECT_EQ(register_of(processor.state(), Register::P), 0x04030201U);
    }
}

TEST(DualPortRam, TakesTwentyFourClocksAWordBehindTheFetch) {
    const auto clocks_of = [](const std::string& text) {
        Processor processor({}, image_of(text));
        processor.run_instruction(1'000);
        return processor.state().clocks;
    };
    for (const char* text : {"LD XI, 0x8000\n", "ST XI, 0x8000\n"}) {
        const ClockCounts clocks = clocks_of(text);
        EXPECT_EQ(clocks.total, 3 + 24) << text;
        EXPECT_EQ(clocks.fetch, 3) << text;
        EXPECT_GE(clocks.data, 8) << text;
        EXPECT_EQ(clocks.publish, 0) << text;
    }
}

TEST(DualPortRam, AlsoReadsConstantsOfTheProgramRom) {
    Processor processor({}, image_of("LD XI, TABLE\nHLT\nTABLE: .byte 0\n.byte 0\n.byte 0xc0\n.byte 0x3f\n"));
    processor.run(1'000);
    EXPECT_EQ(value_of(processor, Register::XI), 1.5);
}

TEST(DualPortRam, IsNoWayAroundTheChecksOfMov) {
    const auto stop_of = [](const std::string& text) {
        Processor processor({}, image_of(text));
        processor.memory().ram[2] = 0x80;
        processor.memory().ram[3] =
            0x7f; // an infinity with the bytes below, which the host left at 0xff: NaN
        processor.run(1'000);
        return processor.state().stop;
    };
    EXPECT_EQ(stop_of("LD XI, 0x8000\nHLT\n"), Stop::no_number);
    EXPECT_EQ(stop_of("LD PC, 0x8000\nHLT\n"), Stop::overflow);
    // What the assembler would refuse, as bytes: into the ROM, across its end and that of the RAM, and behind
    // the last address.
    EXPECT_EQ(stop_of(".byte 0x80\n.byte 0xfe\n.byte 0x7f\nHLT\n"), Stop::across_memories);
    EXPECT_EQ(stop_of(".byte 0x80\n.byte 0xfe\n.byte 0xbf\nHLT\n"), Stop::across_memories);
    EXPECT_EQ(stop_of(".byte 0xa0\n.byte 0xfe\n.byte 0xbf\nHLT\n"), Stop::across_memories);
    EXPECT_EQ(stop_of(".byte 0xa0\n.byte 0x00\n.byte 0x10\nHLT\n"), Stop::rom_write);
    EXPECT_EQ(stop_of(".byte 0x80\n.byte 0xfe\n.byte 0xff\nHLT\n"), Stop::beyond_bus);
    EXPECT_EQ(stop_of(".byte 0xa0\n.byte 0xfe\n.byte 0xff\nHLT\n"), Stop::beyond_bus);
}

TEST(DualPortRam, ComputedRegistersAreStoredAndNotLoaded) {
    Processor processor(
        {},
        image_of("MOV Vmax, 2\nMOV Amax, 8\nMOV XI, 0\nMOV YJ, 0\nMOV Z, 5\nG01Z\nST Vz, 0x8000\n"
                 "LD P, 0x8000\nHLT\n"));
    processor.run(10'000);
    EXPECT_EQ(processor.state().stop, Stop::halted);
    const auto bits = static_cast<std::uint32_t>(register_of(processor.state(), Register::P));
    EXPECT_NEAR(std::bit_cast<float>(bits), 2.0F, 1e-6F);
    EXPECT_FALSE(assemble("LD Vz, 0x8000\n", "x.asm").errors.empty());
}

} // namespace
} // namespace millwright::cordic
