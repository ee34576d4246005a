#include "core/gcode/reader/cordic_motion.h"

#include "core/base/error.h"
#include "core/cordic/assembler.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace millwright::gcode {
namespace {

using kinematics::AxisPositions;

Program motion_of(const std::string& text) {
    const auto [image, lines, errors, warnings] = cordic::assemble(text, "records.asm", cordic::binary64);
    EXPECT_TRUE(errors.empty());
    cordic::Processor processor({}, image);
    processor.run(1'000'000);
    const auto machine = cordic_machine(100.0);
    return cordic_motion(processor, {}, machine, AxisPositions::Zero(3), "records.asm");
}

TEST(CordicMotion, MakesFeedsOfSetPointsAndBlocksOfCommandsInTheirOrder) {
    const Program program = motion_of(R"(
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
    std::vector<BlockKind> kinds;
    for (const Block& block : program.blocks) {
        kinds.push_back(block.kind);
    }
    EXPECT_EQ(kinds,
              (std::vector<BlockKind>{BlockKind::spindle_on,
                                      BlockKind::feed,
                                      BlockKind::dwell,
                                      BlockKind::feed,
                                      BlockKind::coolant_on,
                                      BlockKind::pause,
                                      BlockKind::coolant_off,
                                      BlockKind::spindle_off,
                                      BlockKind::end}));
    EXPECT_EQ(program.blocks[0].spindle_rpm, -9000.0);
    EXPECT_NEAR(program.blocks[1].duration, 0.5, 1e-8); // 5 mm at 10 mm/s
    EXPECT_NEAR(program.blocks[1].feed, 10.0, 1e-6);
    EXPECT_DOUBLE_EQ(program.blocks[2].duration, 1.5);
    EXPECT_NEAR(program.blocks[3].duration, 1.3, 1e-7); // (3, 4, 12) is 13 mm
    EXPECT_EQ(program.blocks[3].target[2], 12.0);
}

TEST(CordicMotion, EndsWhereTheProcessorHalts) {
    EXPECT_EQ(motion_of("HLT").blocks.back().kind, BlockKind::end);
}

TEST(CordicMotion, RefusesASetPointThatIsAwayAndHasNoSpeed) {
    try {
        (void)motion_of("MOV XI, 3\nG01\nHLT\n");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().message,
                    testing::HasSubstr("set-point 1 is 3 mm away and has no speed"));
    }
}

TEST(CordicMachine, KeepsTheAccelerationOfThePathWhicheverWayItGoes) {
    const test::WithoutTraps no_traps;
    const auto machine = cordic_machine(90.0, 1000.0);
    double squares = 0.0;
    for (const auto& axis : machine.axes()) {
        squares += axis.max_acceleration * axis.max_acceleration;
    }
    EXPECT_NEAR(std::sqrt(squares), 90.0, 1e-9);
    EXPECT_TRUE(std::isinf(cordic_machine(90.0).axis(0).max_jerk));
    EXPECT_THROW((void)cordic_machine(0.0), Error);
    EXPECT_THROW((void)cordic_machine(std::nan("")), Error);
}

} // namespace
} // namespace millwright::gcode
