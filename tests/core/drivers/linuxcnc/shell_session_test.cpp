// The session against the emulated LinuxCNC, in computed time.
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include "core/base/error.h"
#include "tests/core/drivers/linuxcnc/linuxcnc_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::drivers::linuxcnc {
namespace {

using kinematics::AxisPositions;
using test::LinuxCncWire;
using testing::HasSubstr;

constexpr const char* square_at_one_feed =
    "G21 G90 G94\nG0 X0 Y0\n(around)\nG1 X20 F600\nG1 Y20\n\nG1 X0\nG1 Y0\nM2\n";

TEST(ShellSession, RunsAProgramToItsEnd) {
    LinuxCncWire wire;
    ASSERT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    wire.start(square_at_one_feed);
    int executed = 0;
    while (wire.state() == DriverState::running) {
        wire.step();
        EXPECT_GE(wire.session.status().executed_blocks, executed);
        executed = wire.session.status().executed_blocks;
    }
    EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    EXPECT_EQ(executed, 8);
    EXPECT_EQ(wire.linuxcnc.truth().ended_runs, 1);
}

TEST(ShellSession, HoldsResumesOverridesAndStops) {
    LinuxCncWire wire;
    wire.start(square_at_one_feed);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.status().position[0] > 5.0; }, 60.0));
    wire.session.set_overrides({.feed = 50});
    wire.session.hold(wire.now);
    EXPECT_EQ(wire.state(), DriverState::holding);
    wire.run_until([] { return false; }, 2.0);
    const AxisPositions rest = wire.linuxcnc.position();
    wire.run_until([] { return false; }, 2.0);
    EXPECT_EQ(wire.linuxcnc.position(), rest);
    EXPECT_EQ(wire.session.status().overrides.feed, 50);
    wire.session.resume(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.status().position[1] > 5.0; }, 60.0));
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::stopped; }, 60.0));
    EXPECT_EQ(wire.session.status().executed_blocks, 4);
    EXPECT_FALSE(wire.linuxcnc.moving());
}

TEST(ShellSession, ExecutesSingleLinesAndTellsWhatIsWrongWithThem) {
    LinuxCncWire wire;
    (void)wire.session.command("G0 X3 Y4", wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::done);
    EXPECT_NEAR(wire.linuxcnc.position()[1], 4.0, 1e-9);
    (void)wire.session.command("G1 Q\nG0 X9", wire.now);
    wire.run_to_end();
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::refused);
    EXPECT_NE(wire.session.status().answer.text, "");
    EXPECT_NEAR(wire.linuxcnc.position()[0], 3.0, 1e-9) << "after a refused line the rest is left out";
    wire.start(square_at_one_feed);
    EXPECT_EQ(wire.session.status().answer.state, CommandAnswer::State::none);
}

TEST(ShellSession, JogsAsFarAsTheHandSays) {
    LinuxCncWire wire;
    Jog jog{AxisPositions::Zero(3), 10.0, 0.0};
    jog.way[1] = -2.5;
    wire.session.jog(jog, wire.now);
    wire.run_to_end();
    EXPECT_NEAR(wire.linuxcnc.position()[1], -2.5, 1e-3);
    jog = {AxisPositions::Zero(3), 10.0, 0.3};
    jog.way[0] = 100.0;
    wire.session.jog(jog, wire.now);
    const double begin = wire.linuxcnc.time();
    wire.run_to_end();
    EXPECT_GT(wire.linuxcnc.position()[0], 1.0);
    EXPECT_LT(wire.linuxcnc.truth().last_motion, begin + 0.3 + 0.25) << "0.1 s, and what was under way";
}

TEST(ShellSession, TellsOneThatEndedFromOneThatWasEndedAtTheMachine) {
    LinuxCncWire wire;
    wire.start(square_at_one_feed);
    wire.run_until([&] { return wire.session.status().position[0] > 5.0; }, 60.0);
    wire.linuxcnc.abort_at_the_machine();
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("ended at the machine"));
}

/// LinuxCNC goes on with the program of a Millwright that was killed.
struct Orphan : ::testing::Test {
    LinuxCncWire wire;

    void SetUp() override {
        wire.start(square_at_one_feed);
        ASSERT_TRUE(wire.run_until([&] { return wire.session.status().position[0] > 5.0; }, 60.0));
        wire.session = ShellSession();
        wire.session.opened(wire.now);
        ASSERT_TRUE(wire.run_until([&] { return wire.session.greeted(); }, 10.0));
        ASSERT_EQ(wire.state(), DriverState::running);
    }
    [[nodiscard]] std::string refusal() {
        try {
            wire.start("G21 G90\nG0 X-5\nM2\n");
        } catch (const Error& error) {
            return to_text(error.diagnostic());
        }
        return "";
    }
};

TEST_F(Orphan, IsNotPushedAsideByAnotherProgram) {
    EXPECT_EQ(wire.session.status().activity, Activity::none);
    EXPECT_THAT(refusal(), HasSubstr("started elsewhere"));
    EXPECT_THROW((void)wire.session.command("G0 X1", wire.now), Error);
    EXPECT_THROW(wire.session.home(wire.now), Error);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 60.0));
    EXPECT_EQ(wire.linuxcnc.truth().ended_runs, 1);
    EXPECT_NEAR(wire.linuxcnc.position()[0], 0.0, 1e-9);
    EXPECT_EQ(refusal(), "");
}

TEST_F(Orphan, IsPausedResumedAndStoppedByAPerson) {
    wire.session.hold(wire.now);
    wire.run_until([] { return false; }, 2.0);
    EXPECT_EQ(wire.state(), DriverState::holding);
    const AxisPositions rest = wire.linuxcnc.position();
    wire.run_until([] { return false; }, 1.0);
    EXPECT_EQ(wire.linuxcnc.position(), rest);
    wire.session.resume(wire.now);
    wire.run_until([] { return false; }, 0.5);
    EXPECT_EQ(wire.state(), DriverState::running);
    EXPECT_NE(wire.linuxcnc.position(), rest);
    wire.session.stop(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::stopped; }, 60.0));
    EXPECT_FALSE(wire.linuxcnc.moving());
}

TEST_F(Orphan, IsNotEndedByLeaving) {
    wire.session.leave(wire.now);
    wire.run_until([] { return false; }, 1.0);
    EXPECT_TRUE(wire.linuxcnc.moving());
}

TEST_F(Orphan, IsFoundAlsoWhenItBeginsLater) {
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::idle; }, 60.0));
    wire.linuxcnc.receive("set mode auto\r\nset run\r\n"); // by another interface
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == DriverState::running; }, 5.0));
    EXPECT_EQ(wire.session.status().activity, Activity::none);
    EXPECT_THAT(refusal(), HasSubstr("started elsewhere"));
}

TEST(ShellSession, TellsALinuxCncThatFallsSilentToStop) {
    LinuxCncWire wire;
    wire.start(square_at_one_feed);
    wire.run_until([&] { return wire.session.status().position[0] > 5.0; }, 60.0);
    wire.go_deaf();
    wire.run_until([&] { return wire.state() == DriverState::alarm; }, 60.0);
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.sent, HasSubstr("set abort"));
    EXPECT_THAT(wire.session.status().message, HasSubstr("a stop was sent"));
}

TEST(ShellSession, DoesNotTakeItsOwnPauseForLinuxCncsSilence) {
    for (int n = 0; n < 20; ++n) {
        LinuxCncWire wire;
        wire.start(square_at_one_feed);
        wire.run_until([] { return false; }, 0.5 + 0.005 * n);
        wire.now += 60.0; // longer than it is waited for; what has come meanwhile is read a moment later
        wire.session.tick(wire.now);
        wire.run_to_end();
        EXPECT_EQ(wire.state(), DriverState::idle) << wire.session.status().message;
    }
}

TEST(ShellSession, EndsInAnAlarmWithLinuxCncsOwnWords) {
    LinuxCncWire wire;
    wire.start("G21 G90 G94\nG1 X10 F1200\nG1 X900\nM2\n");
    wire.run_to_end();
    EXPECT_EQ(wire.state(), DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("exceed"));
    EXPECT_LE(wire.session.status().executed_blocks, 2);
}

TEST(ShellSession, SendsNothingThatMovesAfterAnEmergencyStopOrALostLink) {
    for (const bool lost : {false, true}) {
        LinuxCncWire wire;
        wire.start(square_at_one_feed);
        wire.run_until([&] { return wire.session.status().position[0] > 5.0; }, 60.0);
        if (lost) {
            wire.cut();
        } else {
            wire.linuxcnc.raise_alarm();
        }
        wire.run_to_end();
        EXPECT_EQ(wire.state(), DriverState::alarm);
        EXPECT_THROW(wire.start(square_at_one_feed), Error);
        EXPECT_THROW(wire.session.jog({AxisPositions::Constant(3, 1.0), 10.0, 0.0}, wire.now), Error);
        EXPECT_THROW((void)wire.session.command("G0 X1", wire.now), Error);
        wire.sent.clear();
        wire.run_until([] { return false; }, 30.0);
        EXPECT_EQ(wire.sent.find("set "), std::string::npos) << wire.sent;
    }
}

} // namespace
} // namespace millwright::drivers::linuxcnc
