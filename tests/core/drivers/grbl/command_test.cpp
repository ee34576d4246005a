// Single lines, settings, and block after block, on an emulated Grbl.
#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "core/drivers/mdi_lines.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

namespace millwright::drivers::grbl {
namespace {

using gcode::SpindleTurning;
using kinematics::AxisKind;
using test::GrblWire;
using testing::HasSubstr;

constexpr program::ProgramAxis x_axis{'X', AxisKind::linear};
constexpr program::ProgramAxis z_axis{'Z', AxisKind::linear};

DriverStatus execute(GrblWire& wire, const std::string& lines) {
    const int number = wire.session.command(command_lines(lines), wire.now);
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::pending);
    wire.run_to_end();
    wire.run_until([] { return false; }, 0.3); // a report with everything in it
    EXPECT_EQ(wire.session.status().answer.number, number);
    return wire.session.status();
}

TEST(GrblCommand, IsExecutedAndAnswered) {
    GrblWire wire;
    const DriverStatus status = execute(wire, "G0 X3\nG0 Y4");
    EXPECT_EQ(status.answer.state, CommandAnswer::State::done);
    EXPECT_EQ(status.state, DriverState::idle);
    EXPECT_EQ(wire.grbl.position(), (std::array<double, 3>{3.0, 4.0, 0.0}));
    EXPECT_EQ(status.position[1], 4.0);
}

TEST(GrblCommand, IsRefusedInPlainWordsAndLeavesTheMachineReady) {
    GrblWire wire;
    const DriverStatus status = execute(wire, "G0 X1\nG1 X2\nG0 X3");
    EXPECT_EQ(status.answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(status.answer.text, HasSubstr("G1X2: error 22: the feed rate is not set"));
    EXPECT_EQ(status.state, DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[0], 1.0);
    EXPECT_EQ(execute(wire, "G0 X5").answer.state, CommandAnswer::State::done);
    EXPECT_EQ(wire.grbl.position()[0], 5.0);
}

TEST(GrblCommand, ThatWasRefusedIsForgottenWhenAProgramBegins) {
    GrblWire wire;
    const CommandAnswer refused = execute(wire, "G1 X2").answer;
    ASSERT_EQ(refused.state, CommandAnswer::State::refused);
    wire.start("G0 X1\n");
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::none);
    EXPECT_EQ(wire.session.status().answer.text, "");
    EXPECT_EQ(wire.session.status().answer.number, refused.number);
}

TEST(GrblCommand, IsNotTakenWhileAProgramRuns) {
    GrblWire wire;
    wire.start("G0 X50\nG0 X0\n");
    EXPECT_THROW((void)wire.session.command(command_lines("G0 X1"), wire.now), Error);
}

TEST(GrblCommand, RefusesWhatHasAButtonOfItsOwn) {
    for (const char* line : {"$H", "$X", "$J=X1F1", "$C", "$SLP", "$RST=*", "G0 X1 !", "", " (nothing)"}) {
        EXPECT_THROW((void)command_lines(line), Error) << line;
    }
    EXPECT_EQ(command_lines(" $110=500 ").lines.front().text, "$110=500");
}

TEST(GrblCommand, TellsWhatIsInForce) {
    GrblWire wire({}, {.mist = true});
    EXPECT_TRUE(wire.session.readout().mist);
    EXPECT_FALSE(GrblWire().session.readout().mist);
    EXPECT_EQ(wire.session.status().work_system, 1);
    EXPECT_THAT(wire.session.status().modes, HasSubstr("G54"));
    const DriverStatus status = execute(
        wire, work_system_name(3) + "\n" + start_spindle(800.0, false) + "\n" + set_coolant(true, true));
    EXPECT_EQ(status.work_system, 3);
    EXPECT_EQ(status.spindle, SpindleTurning::counterclockwise);
    EXPECT_EQ(status.spindle_rpm, 800.0);
    EXPECT_TRUE(status.coolant.mist && status.coolant.flood);
    const DriverStatus off = execute(wire, stop_spindle() + "\n" + set_coolant(false, false));
    EXPECT_EQ(off.spindle, SpindleTurning::stopped);
    EXPECT_FALSE(off.coolant.mist || off.coolant.flood);
}

TEST(GrblCommand, SetsTheWorkPosition) {
    GrblWire wire;
    (void)execute(wire, "G0 X10 Y20");
    const DriverStatus status = execute(wire, set_work_position(x_axis, 2.5));
    EXPECT_EQ(status.position[0], 10.0);
    EXPECT_EQ(status.work_offset[0], 7.5);
    EXPECT_EQ(status.work_position()[0], 2.5);
    EXPECT_EQ(wire.session.readout().offsets.at("G54")[0], 7.5);
    EXPECT_EQ(wire.session.readout().offsets.at("G55")[0], 0.0);
}

TEST(GrblCommand, Probes) {
    GrblWire wire({}, {.surface = [](double, double) { return -3.25; }});
    const auto down = [&] { return probe_line(z_axis, 2, -10.0, 5.0, wire.session.status()); };
    const DriverStatus status = execute(wire, down());
    ASSERT_TRUE(status.probe);
    EXPECT_TRUE(status.probe->touched);
    EXPECT_NEAR(status.probe->position[2], -3.25, 0.005);
    (void)execute(wire, "G0 Z0");
    EXPECT_EQ(execute(wire, down()).probe->number, 2);
}

TEST(GrblCommand, EndsInAnAlarmWhereTheProbeTouchesNothing) {
    GrblWire wire;
    const DriverStatus status = execute(wire, probe_line(z_axis, 2, -2.0, 5.0, wire.session.status()));
    EXPECT_EQ(status.state, DriverState::alarm);
    EXPECT_EQ(status.answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(status.answer.text, HasSubstr("alarm 5"));
}

TEST(GrblCommand, WritesASettingAndReadsItBack) {
    GrblWire wire;
    EXPECT_EQ(execute(wire, "$110=1234.5").answer.state, CommandAnswer::State::done);
    EXPECT_EQ(wire.session.readout().settings.at(110), 1234.5);
    const DriverStatus status = execute(wire, "$20=1");
    EXPECT_EQ(status.answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(status.answer.text, HasSubstr("soft limits require homing"));
    EXPECT_EQ(wire.session.readout().settings.at(20), 0.0);
}

TEST(GrblCommand, ShowsWhichSwitchesAreOn) {
    GrblWire wire;
    wire.grbl.set_door(true);
    wire.run_until([] { return false; }, 0.5);
    EXPECT_TRUE(wire.session.status().inputs.door);
    EXPECT_FALSE(wire.session.status().inputs.probe);
    EXPECT_EQ(wire.session.status().inputs.limits, "");
}

TEST(GrblCommand, ClaimsNothingOfAProgramThatWasBrokenOffBefore) {
    GrblWire wire;
    wire.start("G0 X100\nG0 X0\nG0 X100\nG0 X0\n");
    wire.run_until([&] { return wire.grbl.position()[0] > 20.0; }, 60.0);
    wire.session.emergency_stop(wire.now);
    wire.run_until([] { return false; }, 2.0);
    wire.session.reset(wire.now);
    wire.run_until([&] { return wire.session.greeted(); }, 5.0);
    const int claimed = wire.session.status().executed_blocks;
    Jog jog;
    jog.way = kinematics::AxisPositions::Ones(3);
    jog.speed = 10.0;
    wire.session.jog(jog, wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.session.status().executed_blocks, claimed);
}

TEST(GrblSingleBlock, RestsAfterEachBlock) {
    GrblWire wire;
    wire.session.set_single_block(true);
    wire.start("G0 X1\nG0 X2\nM3 S100\nG0 X3\n");
    for (int n = 1; n <= 3; ++n) {
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 10.0)) << n;
        EXPECT_EQ(wire.session.status().executed_blocks, n);
        EXPECT_EQ(wire.grbl.position()[0], std::min(n, 2));
        wire.run_until([] { return false; }, 2.0);
        EXPECT_EQ(wire.grbl.position()[0], std::min(n, 2));
        EXPECT_THAT(wire.session.status().message, HasSubstr(n == 2 ? "line 3" : "line"));
        wire.session.resume(wire.now);
    }
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.session.status().executed_blocks, 4);
}

TEST(GrblSingleBlock, CanBeSwitchedOnAndOffOnTheWay) {
    GrblWire wire;
    std::string program;
    for (int n = 1; n <= 60; ++n) {
        program += "G0 X" + std::to_string(n) + "\n";
    }
    wire.start(program);
    wire.run_until([&] { return wire.grbl.position()[0] > 10.0; }, 60.0);
    wire.session.set_single_block(true);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::holding; }, 60.0));
    EXPECT_LT(wire.grbl.position()[0], 10.0 + 40.0); // what it had already
    wire.session.set_single_block(false);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.state(), DriverState::holding);
    wire.session.resume(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.position()[0], 60.0);
}

} // namespace
} // namespace millwright::drivers::grbl
