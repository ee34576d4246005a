#include "core/cordic_machine/cordic_motion.h"

#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace millwright::cordic_machine {
namespace {

using kinematics::AxisPositions;

constexpr double no_limit = std::numeric_limits<double>::infinity();

CordicMotion whole_motion_of(const std::string& text, double most_acceleration = no_limit) {
    auto [image, lines, errors, warnings] = cordic::assemble(text, "records.asm", cordic::binary64);
    EXPECT_TRUE(errors.empty());
    cordic::Processor processor({}, image);
    processor.run(1'000'000);
    const auto machine = cordic_machine(100.0);
    CordicProgram made;
    made.code_lines = std::move(lines);
    return cordic_motion(processor, made, machine, AxisPositions::Zero(3), "records.asm", most_acceleration);
}

program::Program motion_of(const std::string& text) {
    return whole_motion_of(text).program;
}

TEST(CordicMotion, MakesFeedsOfSetPointsAndBlocksOfCommandsInTheirOrder) {
    const program::Program program = motion_of(R"(
        MOV P, 9000
        M04
        MOV Vmax, 10
        MOV Amax, 100
        MOV XI, 3
        MOV YJ, 4
        G01
        MOV P, 1500000
        G04
        MOV Z, 12
        MOV XI, 6
        MOV YJ, 8
        G01Z
        M08
        M00
        M09
        M05
        M30
    )");
    std::vector<program::BlockKind> kinds;
    for (const program::Block& block : program.blocks) {
        kinds.push_back(block.kind);
    }
    EXPECT_EQ(kinds,
              (std::vector<program::BlockKind>{program::BlockKind::spindle_on,
                                               program::BlockKind::feed,
                                               program::BlockKind::dwell,
                                               program::BlockKind::feed,
                                               program::BlockKind::coolant_on,
                                               program::BlockKind::pause,
                                               program::BlockKind::coolant_off,
                                               program::BlockKind::spindle_off,
                                               program::BlockKind::end}));
    EXPECT_EQ(program.blocks[0].spindle_rpm, -9000.0);
    EXPECT_NEAR(program.blocks[1].duration, 0.5, 1e-8); // 5 mm at 10 mm/s
    EXPECT_NEAR(program.blocks[1].feed, 10.0, 1e-6);
    EXPECT_DOUBLE_EQ(program.blocks[2].duration, 1.5);
    EXPECT_NEAR(program.blocks[3].duration, 1.3, 1e-7); // (3, 4, 12) is 13 mm
    EXPECT_EQ(program.blocks[3].target[2], 12.0);
}

TEST(CordicMotion, EndsWhereTheProcessorHalts) {
    EXPECT_EQ(motion_of("HLT").blocks.back().kind, program::BlockKind::end);
}

TEST(CordicMotion, GivesEachFeedTheAccelerationOfItsRecord) {
    const std::string text = "MOV Vmax, 10\nMOV Amax, 100\nMOV XI, 3\nMOV YJ, 4\nG01\n"
                             "MOV Amax, 60\nMOV Z, 12\nG01Z\nHLT\n";
    const CordicMotion motion = whole_motion_of(text);
    ASSERT_EQ(motion.accelerations.size(), motion.program.blocks.size());
    EXPECT_NEAR(motion.accelerations[0], 50.0, 1e-6); // half of Amax
    EXPECT_NEAR(motion.accelerations[1], 30.0, 1e-6);
    EXPECT_TRUE(std::isinf(motion.accelerations.back())) << "the end is no motion";
    const std::vector<double> slower = whole_motion_of(text, 40.0).accelerations;
    EXPECT_EQ(slower[0], 40.0);
    EXPECT_NEAR(slower[1], 30.0, 1e-6);
}

TEST(CordicMotion, RefusesASetPointWhoseAccelerationTheFormatTakesForNothing) {
    const auto fault_of = [](const std::string& text) {
        try {
            (void)motion_of(text);
            return std::string();
        } catch (const Error& error) {
            EXPECT_GT(error.diagnostic().place.line, 0);
            return error.diagnostic().message;
        }
    };
    EXPECT_THAT(
        fault_of(".format q8.8\nMOV Vmax, 10\nMOV Amax, 0.00390625\nMOV XI, 3\nG01\nHLT\n"),
        testing::HasSubstr("set-point 1 is 3 mm away but has no acceleration: it was rounded to 0 in q8.8"));
}

TEST(CordicMachine, HasThreeAxesAsFastAsTheRecordsAsk) {
    const test::WithoutTraps no_traps;
    const auto machine = cordic_machine(90.0, 1000.0);
    EXPECT_EQ(machine.axis_count(), 3);
    for (const auto& axis : machine.axes()) {
        EXPECT_EQ(axis.max_acceleration, 90.0);
        EXPECT_EQ(axis.max_jerk, 1000.0);
    }
    EXPECT_TRUE(std::isinf(cordic_machine(90.0).axis(0).max_jerk));
    EXPECT_THROW((void)cordic_machine(0.0), Error);
    EXPECT_THROW((void)cordic_machine(std::nan("")), Error);
}

} // namespace
} // namespace millwright::cordic_machine
