#include "core/cordic/assembler.h"
#include "core/cordic/processor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::cordic {
namespace {

Processor halted_program(const std::string& text, const ProcessorSettings& settings = {}) {
    const auto [image, lines, errors, warnings] = assemble(text, "commands.asm");
    EXPECT_TRUE(errors.empty()) << errors[0].message;
    Processor processor(settings, image);
    processor.run(100'000);
    EXPECT_EQ(processor.state().stop, Stop::halted) << to_text(processor.state().stop);
    return processor;
}

TEST(Commands, AreHandedOverInTheirOrderWithTheirParameter) {
    const Processor done = halted_program(R"(
        MOV P, 12000
        M03
        M08
        MOV Vmax, 1
        MOV Amax, 1
        MOV XI, 3
        G01
        MOV P, 250000
        G04
        M05
        M09
        M30
        M00
    )");
    struct Wanted {
        Opcode opcode;
        std::uint32_t parameter;
        int behind;
    };
    const std::vector<Wanted> wanted = {{Opcode::m03, 12000, 0},
                                        {Opcode::m08, 0, 0},
                                        {Opcode::g04, 250'000, 1},
                                        {Opcode::m05, 0, 1},
                                        {Opcode::m09, 0, 1},
                                        {Opcode::m30, 0, 1}};
    ASSERT_EQ(done.commanded().size(), wanted.size()); // M30 is the end
    for (std::size_t n = 0; n < wanted.size(); ++n) {
        EXPECT_EQ(done.commanded()[n].opcode, wanted[n].opcode) << n;
        EXPECT_EQ(done.commanded()[n].parameter, wanted[n].parameter) << n;
        EXPECT_EQ(done.commanded()[n].behind_set_points, wanted[n].behind) << n;
    }
}

TEST(Commands, AllOfM00ToM09AndM30AreKnown) {
    for (const char* name : {"M00", "M01", "M03", "M04", "M05", "M06", "M07", "M08", "M09", "MUSER", "G04"}) {
        const Processor done = halted_program(std::string("MOV P, 7\n") + name + "\nHLT\n");
        ASSERT_EQ(done.commanded().size(), 1U) << name;
        EXPECT_EQ(to_text(done.commanded()[0].opcode), name);
        EXPECT_EQ(done.commanded()[0].parameter, takes_parameter(done.commanded()[0].opcode) ? 7U : 0U);
        EXPECT_TRUE(is_command(done.commanded()[0].opcode));
    }
    for (const char* name : {"M02", "M30"}) {
        EXPECT_EQ(halted_program(name).commanded().size(), 1U) << name;
    }
}

TEST(Commands, GoOverTheBusBehindTheRecords) {
    ProcessorSettings settings;
    settings.publishing = Publishing::bus;
    Processor done = halted_program("MOV P, 0x01020304\nM03\nHLT\n", settings);
    const std::vector<std::uint8_t>& port = done.memory().port;
    EXPECT_EQ(port.at(command_port), 0x43);
    EXPECT_EQ(port.at(command_port + 1U), 4);
    EXPECT_EQ(port.at(command_port + 2U), 3);
    EXPECT_EQ(port.at(command_port + 3U), 2);
    EXPECT_EQ(port.at(command_port + 4U), 1);
    EXPECT_EQ(done.state().clocks.publish, 5 * 2);
    EXPECT_EQ(halted_program("M30", settings).commanded().size(), 1U);
}

TEST(Commands, ComputedRegistersCannotBeLoaded) {
    const auto errors = assemble("MOV Vz, 1\n", "wrong.asm").errors;
    ASSERT_EQ(errors.size(), 1U);
    EXPECT_EQ(errors[0].place.column, 5);
    EXPECT_THAT(errors[0].message, testing::HasSubstr("Vz is a computed register and cannot be loaded"));
}

} // namespace
} // namespace millwright::cordic
