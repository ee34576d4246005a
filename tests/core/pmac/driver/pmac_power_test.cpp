// Motors that cannot go where they are sent, or have lost or get no power: F2, in computed time.
#include "core/pmac/driver/internal/following_watch.h"
#include "core/pmac/driver/internal/guarded_line.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::PmacWire;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(PmacFollowingWatch, TellsAMotorThatStands) {
    FollowingWatch watch(2);
    double time = 0.0;
    for (; time < 0.49; time += 0.02) {
        EXPECT_FALSE(watch.left_behind({0.0, 0.6}, {3.0 + time, 7.0}, time)) << time;
    }
    EXPECT_EQ(watch.left_behind({0.0, 0.6}, {3.5, 7.0}, time + 0.02), 1U);
}

TEST(PmacFollowingWatch, TellsAMotorThatGoesTheOtherWay) {
    FollowingWatch watch(1);
    std::optional<std::size_t> told;
    for (double time = 0.0; time < 0.6 && !told; time += 0.02) {
        told = watch.left_behind({-2.0}, {5.0 * time}, time);
    }
    EXPECT_EQ(told, 0U);
}

TEST(PmacFollowingWatch, LeavesALoopAloneThatIsWeakAndOneThatSettles) {
    FollowingWatch weak(1), settling(1);
    for (double time = 0.0; time < 5.0; time += 0.02) {
        EXPECT_FALSE(weak.left_behind({4.0}, {1.0 * time}, time));
        EXPECT_FALSE(settling.left_behind({0.2}, {0.0}, time));
    }
}

TEST(PmacFollowingWatch, LeavesAMotorAloneWhosePlacesAreCountedAnew) {
    FollowingWatch watch(1);
    double place = 0.0;
    for (double time = 0.0; time < 3.0; time += 0.02) {
        place = place > 40.0 ? 0.0 : place + 1.0;
        EXPECT_FALSE(watch.left_behind({1.0}, {place}, time)) << time;
    }
}

TEST(PmacFollowingWatch, HasSeenNothingWhileTheComputerWasBusy) {
    FollowingWatch watch(1);
    EXPECT_FALSE(watch.left_behind({1.0}, {0.0}, 0.0));
    EXPECT_FALSE(watch.left_behind({1.0}, {0.0}, 3.0));
}

/// Renewed as a window does, until the arm is in alarm: s of the card's time, or -1 after `longest`.
double held_until_alarm(PmacWire& wire, const drivers::Jog& jog, double longest) {
    const double begin = wire.card.time();
    while (wire.card.time() - begin < longest) {
        if (wire.state() == drivers::DriverState::alarm) {
            return wire.card.time() - begin;
        }
        wire.session.jog(jog, wire.now);
        wire.pass(0.016);
    }
    return -1.0;
}

TEST(PmacPowerF2, AHeldJogOfAmplifiersWithoutPowerEndsInAlarm) {
    for (const double speed : {5.0, 1.0}) {
        PmacWire wire;
        const drivers::Jog jog = jog_of(0, speed, speed, 0.1);
        ASSERT_EQ(held_until_alarm(wire, jog, 2.0), -1.0) << wire.session.status().message;
        ASSERT_FALSE(wire.standing());
        wire.card.emergency_stop();
        const double taken = held_until_alarm(wire, jog, 5.0);
        EXPECT_GT(taken, 0.0);
        EXPECT_LT(taken, 1.2);
        EXPECT_THAT(wire.session.status().message,
                    AllOf(HasSubstr("does not move"), HasSubstr("that its amplifier has power")));
        wire.pass(0.5);
        EXPECT_FALSE(wire.powered());
    }
}

TEST(PmacPowerF2, AStepThatIsNotMadeNamesItsJointAndWhereItWasSent) {
    PmacWire wire;
    wire.pass(0.2); // following errors are reported
    wire.card.emergency_stop();
    wire.session.jog(jog_of(1, 0.1, 5.0), wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 3.0));
    EXPECT_THAT(
        wire.session.status().message,
        testing::StartsWith(
            "Y is enabled but not at its commanded position: it is at 0.00 degrees instead of 0.10;"));
}

TEST(PmacPowerF2, MotorsThatTakeNoPowerSaySo) {
    PmacWire wire({}, false);
    wire.card.raise_alarm();
    wire.session.enable(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 2.0));
    EXPECT_EQ(wire.session.status().message,
              "motor 1: its amplifier reports a fault, and it cannot be enabled");
    wire.card.clear_faults();
    wire.session.reset(wire.now);
    wire.session.enable(wire.now);
    wire.pass(2.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_TRUE(wire.powered());
}

// Sooner or later, by how far its offset drives it: before the card was asked, or long after.
TEST(PmacPowerF2, AMotorThatTripsAtRestAfterItGotPowerSaysWhy) {
    for (const char* const limit : {"16", "160", "400", "424", "434"}) { // of 437: where the loop holds it
        PmacWire wire({}, false, "XYZA", {}, std::string("I129=10\nI111=") + limit + "\n");
        wire.session.enable(wire.now);
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 2.0))
            << limit;
        wire.pass(0.1);
        EXPECT_THAT(wire.session.status().message,
                    testing::StartsWith("motor 1: its following error exceeded the limit"))
            << limit;
        EXPECT_FALSE(wire.powered());
    }
}

// As `arm direction` asks, one line behind the other: a machine at rest is not watched meanwhile.
TEST(PmacPowerF2, AMotorThatTripsWhileTheCardIsAskedSaysWhy) {
    PmacWire wire({}, false, "XYZA", {}, "I129=10\nI111=434\n");
    wire.session.enable(wire.now);
    for (int n = 0; n < 2000 && wire.state() != drivers::DriverState::alarm; ++n) {
        if (wire.session.status().activity == drivers::Activity::none) {
            (void)refusal([&] { (void)wire.session.command({"I122", "I123", "I124", "I125"}, false); });
        }
        wire.step(0.001);
    }
    ASSERT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_THAT(wire.session.status().message,
                testing::StartsWith("motor 1: its following error exceeded the limit"));
}

TEST(PmacPowerF2, AFaultOfAnAmplifierAtRestIsAnAlarm) {
    PmacWire wire;
    wire.pass(1.0);
    ASSERT_EQ(wire.state(), drivers::DriverState::idle);
    wire.card.raise_alarm();
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 1.0));
    wire.pass(0.1);
    EXPECT_EQ(wire.session.status().message, "motor 1: its amplifier reports a fault");
}

// A report is asked for in the middle of it: what a motor without power tells comes with the next one.
TEST(PmacPowerF2, AFaultOfAnAmplifierIsTheReasonWheneverItComes) {
    for (int phase = 0; phase < 24; ++phase) {
        PmacWire wire;
        wire.session.jog(jog_of(1, 40.0, 5.0), wire.now);
        wire.pass(1.0);
        for (int n = 0; n < phase; ++n) {
            wire.step(0.001);
        }
        wire.card.raise_alarm();
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 1.0));
        wire.pass(0.1);
        EXPECT_THAT(wire.session.status().message, HasSubstr("its amplifier reports a fault")) << phase;
    }
}

TEST(PmacPowerF2, ACardThatWasSwitchedOffAndOnIsNotToldAsSilent) {
    for (const bool moves : {false, true}) {
        PmacWire wire;
        if (moves) {
            wire.session.jog(jog_of(1, 40.0, 5.0), wire.now);
        }
        wire.pass(1.0);
        wire.card.power_cycle();
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 3.0));
        EXPECT_THAT(wire.session.status().message,
                    AllOf(HasSubstr("reset"), Not(HasSubstr("did not answer"))));
    }
    PmacWire begun;
    begun.card.power_cycle();
    begun.session.jog(jog_of(1, 4.0, 5.0), begun.now);
    ASSERT_TRUE(begun.run_until([&] { return begun.state() == drivers::DriverState::alarm; }, 3.0));
    EXPECT_THAT(begun.session.status().message, AllOf(HasSubstr("reset"), Not(HasSubstr("P1002="))));
    PmacWire deaf;
    deaf.go_deaf();
    ASSERT_TRUE(deaf.run_until([&] { return deaf.state() == drivers::DriverState::alarm; }, 3.0));
    EXPECT_THAT(deaf.session.status().message, HasSubstr("the card did not answer"));
}

TEST(PmacGuardedLine, ThatMovesIsNotSentAgainUnasked) {
    GuardedLine moving(0.5), asking(0.5);
    moving.send("#1J=784", false, 0.0);
    asking.send("#1P", true, 0.0);
    (void)moving.take_output();
    (void)asking.take_output();
    std::string of_moving, of_asking;
    GuardedLine::Outcome outcome = GuardedLine::Outcome::none;
    for (double now = 0.01; now < 0.4; now += 0.01) { // the card is silent
        if (const auto reply = moving.poll(now); reply.outcome != GuardedLine::Outcome::none) {
            outcome = reply.outcome;
        }
        (void)asking.poll(now);
        of_moving += moving.take_output();
        of_asking += asking.take_output();
    }
    EXPECT_EQ(outcome, GuardedLine::Outcome::unsent);
    EXPECT_EQ(of_moving, "\x18");
    EXPECT_THAT(of_asking, HasSubstr("#1P"));
}

TEST(PmacGuardedLine, AnAnswerOfACardThatWasResetIsLostAtOnce) {
    for (const std::string answer : {"\n", "12"}) {
        GuardedLine line(3.0);
        line.send("#1J=784", false, 0.0);
        line.receive(std::string(1, checksum("#1J=784")), 0.001);
        line.receive(answer, 0.002);
        double now = 0.002;
        while (now < 3.0 && line.poll(now).outcome == GuardedLine::Outcome::none) {
            now += 0.01;
        }
        EXPECT_LT(now, answer == "\n" ? 0.01 : 0.3);
    }
}

/// Does something with the next jog's line on its way. What the session has sent from then on is in `sent`.
void with_next_jog(PmacWire& wire, const std::function<void(std::string& line)>& happens) {
    wire.on_the_way = [&wire, happens, done = false](std::string& bytes) mutable {
        if (!done && bytes.find("#1J=") != std::string::npos) {
            done = true;
            wire.sent.clear();
            happens(bytes);
        }
    };
}

TEST(PmacPowerF2, AJogThatDidNotComeAsItWasSentIsSentAgainAfterALookAtTheCard) {
    PmacWire wire;
    with_next_jog(wire, [](std::string& line) { line[line.find("J=") + 2] = '9'; }); // 940 for 240
    wire.session.jog(jog_of(0, 2.0, 5.0), wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 3.0));
    EXPECT_NEAR(wire.degrees(0), 2.0, 0.1);
    const std::size_t look = wire.sent.find("#1?P"), again = wire.sent.find("#1J=240");
    ASSERT_NE(again, std::string::npos);
    EXPECT_LT(look, again);
}

// It counts from its new zero, and moves at its own speed.
TEST(PmacPowerF2, ACardThatWasResetWhileAJogsLineWasLostDoesNotGetItAgain) {
    PmacWire wire;
    with_next_jog(wire, [&wire](std::string& line) {
        line.clear();
        wire.card.power_cycle();
    });
    wire.session.jog(jog_of(0, 2.0, 5.0), wire.now);
    const bool alarm = wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 3.0);
    EXPECT_TRUE(alarm);
    EXPECT_EQ(wire.sent.find("J="), std::string::npos);
    EXPECT_FALSE(wire.powered());
    wire.pass(1.0);
    EXPECT_EQ(wire.sent.find("J="), std::string::npos);
    EXPECT_FALSE(wire.powered());
    EXPECT_TRUE(wire.standing());
}

} // namespace
} // namespace millwright::pmac::internal
