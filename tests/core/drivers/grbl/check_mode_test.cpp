// A program that an emulated controller reads in its check mode.
#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "tests/core/drivers/grbl/grbl_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

namespace millwright::drivers::grbl {
namespace {

using test::GrblWire;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

CommandAnswer checked(GrblWire& wire, const std::string& program) {
    const int number = wire.session.check(program_lines(test::listing_of(program), "test.ngc"), wire.now);
    EXPECT_EQ(wire.session.status().activity, Activity::check);
    wire.run_to_end();
    wire.run_until([] { return false; }, 0.3);
    EXPECT_EQ(wire.session.status().answer.number, number);
    return wire.session.status().answer;
}

std::string long_program(int lines) {
    std::string text = "G21 G90 G54\nM3 S1000\nG1 F600\n";
    for (int n = 0; n < lines; ++n) {
        text += "X" + std::to_string(n % 50) + " Y" + std::to_string(n % 7) + "\n";
    }
    return text + "M5\nM30\n";
}

TEST(GrblCheckMode, ReadsAProgramAndNothingMoves) {
    GrblWire wire;
    const CommandAnswer answer = checked(wire, long_program(300));
    EXPECT_EQ(answer.state, CommandAnswer::State::done) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("read 305 lines"));
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(wire.grbl.truth().lost_bytes, 0);
    EXPECT_EQ(wire.grbl.truth().lines.size(), 1U); // the modes that are brought back
    EXPECT_LT(wire.grbl.truth().last_motion, 0.0);
    EXPECT_EQ(wire.grbl.position(), (std::array<double, 3>{0.0, 0.0, 0.0}));
    wire.start("G0 X5\n");
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.grbl.position()[0], 5.0);
}

TEST(GrblCheckMode, NamesEachLineThatIsRefused) {
    GrblWire wire;
    const CommandAnswer answer = checked(wire, "G21 G90\nG1 X5 F100\nM6 T1\nG1 X5 A4\n\nG0 X0\nM30\n");
    EXPECT_EQ(answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(
        answer.text,
        AllOf(HasSubstr("line 3: error 20"), HasSubstr("line 4: error 20"), Not(HasSubstr("line 6"))));
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
}

/// Its arcs begin where the moves before have ended, although nothing has moved.
TEST(GrblCheckMode, FollowsTheProgramsPosition) {
    GrblWire wire;
    const CommandAnswer answer = checked(wire, "G21 G90 F100\nG1 X10\nG2 X20 Y0 I5 J0\nG2 X30 Y0 I4 J0\n");
    EXPECT_EQ(answer.state, CommandAnswer::State::refused);
    EXPECT_THAT(answer.text, AllOf(HasSubstr("line 4: error 33"), Not(HasSubstr("line 3"))));
}

TEST(GrblCheckMode, LeavesTheModesAsTheyWere) {
    GrblWire wire;
    (void)wire.session.command(command_lines("G55\nG20 G91 G18\nG1 F20"), wire.now);
    wire.run_to_end();
    wire.run_until([] { return false; }, 0.3);
    const std::string before = wire.session.readout().modes.text;
    EXPECT_THAT(before, HasSubstr("G55"));
    EXPECT_EQ(checked(wire, long_program(3)).state, CommandAnswer::State::done);
    EXPECT_EQ(wire.session.readout().modes.text, "G0" + before.substr(2)); // the kind of motion is not set
    EXPECT_EQ(wire.session.status().work_system, 2);
}

TEST(GrblCheckMode, EndsAtASoftLimitWithItsLine) {
    GrblWire wire({}, {}, {}, "$22=1\n$20=1");
    wire.session.reset(wire.now);
    wire.run_until([] { return false; }, 1.0);
    wire.session.home(wire.now);
    wire.run_until([&] { return wire.state() == DriverState::idle; }, 120.0);
    const auto before = wire.grbl.position();
    const CommandAnswer answer = checked(wire, "G21 G90 G53\nG53 G0 X-5\nG53 G0 X-5000\nG53 G0 X-6\n");
    EXPECT_EQ(answer.state, CommandAnswer::State::refused);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("at line 3, "));
    EXPECT_TRUE(wire.session.status().position_doubt.empty());
    EXPECT_EQ(wire.grbl.position(), before);
}

TEST(GrblCheckMode, IsRefusedWhereItWouldChangeWhatStays) {
    GrblWire wire;
    const auto check = [&](const std::string& program) {
        return wire.session.check(program_lines(test::listing_of(program), "test.ngc"), wire.now);
    };
    EXPECT_THROW((void)check("G0 X1\nG10 L20 P1 X0\n"), Error); // real Grbl stores it in check mode, too
    (void)wire.session.command(command_lines("G92 X7"), wire.now);
    wire.run_to_end();
    wire.run_until([] { return false; }, 0.3);
    EXPECT_THROW((void)check("G0 X1\n"), Error); // the reset at its end forgets G92
    EXPECT_EQ(wire.state(), DriverState::idle);
}

TEST(GrblCheckMode, IsStoppedWithThePositionKept) {
    GrblWire wire;
    (void)wire.session.check(program_lines(test::listing_of(long_program(4000)), "test.ngc"), wire.now);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.state(), DriverState::running);
    wire.session.hold(wire.now); // nothing moves that could be held
    EXPECT_EQ(wire.state(), DriverState::running);
    const std::string doubt_before = wire.session.status().position_doubt; // switched on and not homed
    wire.session.stop(wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::stopped) << wire.session.status().message;
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::refused);
    EXPECT_EQ(wire.session.status().position_doubt, doubt_before);
    wire.start("G0 X5\n");
    EXPECT_TRUE(wire.run_to_end());
    EXPECT_EQ(wire.grbl.position()[0], 5.0);
}

TEST(GrblCheckMode, OfALostLinkNothingIsSaidToMove) {
    GrblWire wire;
    (void)wire.session.check(program_lines(test::listing_of(long_program(4000)), "test.ngc"), wire.now);
    wire.run_until([] { return false; }, 1.0);
    wire.cut();
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, Not(HasSubstr("may still execute")));
}

/// grblHAL answers every line after an error with that error.
TEST(GrblCheckMode, OfGrblHalNamesTheFirstRefusalAlone) {
    GrblWire wire({}, {.firmware = emulators::EmulatedFirmware::grblhal, .axes = "XYZ"});
    const CommandAnswer answer = checked(wire, "G21 G90\nG1 X5 F100\nG1 X5 J4\nG0 X0\nM30\n");
    EXPECT_EQ(answer.state, CommandAnswer::State::refused);
    EXPECT_EQ(std::ranges::count(answer.text, '\n'), 0) << answer.text;
    EXPECT_THAT(answer.text, HasSubstr("line 3"));
    EXPECT_EQ(wire.state(), DriverState::idle);
    EXPECT_EQ(checked(wire, long_program(20)).state, CommandAnswer::State::done);
}

} // namespace
} // namespace millwright::drivers::grbl
