// Jogs and homing by the driver at the emulated card: F2, F3, in computed time.
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::PmacWire;
using test::refusal;
using testing::AllOf;
using testing::HasSubstr;

TEST(PmacJogF3, IsNoFasterThanItsLimitWhateverIx22Says) {
    PmacWire wire;
    EXPECT_EQ(wire.card.variable('I', 322), 32.0); // 213 degrees per second
    wire.session.jog(jog_of(2, 20.0, 500.0), wire.now);
    double fastest = 0.0;
    for (int n = 0; n < 1000; ++n) {
        wire.step();
        fastest = std::max(fastest, std::abs(wire.card.speed(3)) / 150.0);
    }
    EXPECT_LT(fastest, 5.1);
    EXPECT_GT(fastest, 4.9);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    wire.pass(0.5);
    EXPECT_NEAR(wire.degrees(2), 20.0, 0.01);
}

/// deg/s of motor 3 at most, until everything is at rest.
double fastest_of_motor_3(PmacWire& wire) {
    double fastest = 0.0;
    EXPECT_TRUE(wire.run_until([&] { return std::abs(wire.card.speed(3)) > 10.0; }, 2.0));
    do {
        wire.step();
        fastest = std::max(fastest, std::abs(wire.card.speed(3)) / 150.0);
    } while (wire.state() == drivers::DriverState::running);
    wire.pass(0.5);
    return fastest;
}

TEST(PmacJogF3, GivesTheCardItsOwnJogSpeedBack) {
    PmacWire wire;
    (void)wire.session.command({"I322=20"}, false);
    wire.pass(0.5);
    for (int n = 0; n < 2; ++n) {
        wire.session.jog(jog_of(2, 2.0, 1.0), wire.now);
        EXPECT_LT(fastest_of_motor_3(wire), 1.1);
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
        EXPECT_NEAR(wire.card.variable('I', 322), 20.0, 1e-6);
        EXPECT_NEAR(to_degrees(wire.session.limits()[2].jog_speed.value()), 20e3 / 150.0, 1e-9);
    }
}

TEST(PmacJogF3, ThatIsTypedIsNoFasterThanOneByHand) {
    for (const bool homed : {true, false}) {
        PmacWire wire({}, homed);
        wire.session.let_lines_give_power();
        (void)wire.session.command({"#3J:1500"}, false);
        EXPECT_LT(fastest_of_motor_3(wire), 5.1);
        EXPECT_NEAR(wire.card.position(3), 1500.0, 2.0);
        EXPECT_EQ(wire.card.variable('I', 322), 32.0);
        (void)wire.session.command({"I322=0.3", "#3J:-300"}, false); // 2 degrees per second
        EXPECT_LT(fastest_of_motor_3(wire), 2.1);
        EXPECT_NEAR(wire.card.variable('I', 322), 0.3, 1e-6);
    }
}

// A step test sees nothing of a loop that is led up a ramp.
TEST(PmacJogF3, ThatIsTypedAndShortIsAsFastAsTheCard) {
    PmacWire wire;
    (void)wire.session.command({"I319=1000", "I320=1", "I321=0", "I322=1000"}, false);
    wire.pass(0.5);
    (void)wire.session.command({"#3J:200 M1023"}, false); // 1.3 degrees
    EXPECT_GT(fastest_of_motor_3(wire), 20.0);
    (void)wire.session.command({"#3J:400"}, false);
    EXPECT_LT(fastest_of_motor_3(wire), 6.0);
}

TEST(PmacJogF3, ThatIsTypedAndWouldEndBeyondALimitIsNotSent) {
    PmacWire wire;
    for (const std::string line :
         {"#1J=24000", "#1J:24000", "J=-24000", "#2P #1 J ^ 24000.5", "#2J=0#1J=24000"}) {
        EXPECT_THAT(
            refusal([&] { (void)wire.session.command({line}, false); }),
            AllOf(HasSubstr("'" + line + "' is not sent: X would exceed its limits"), HasSubstr("200")))
            << line;
    }
    EXPECT_THAT(refusal([&] {
                    (void)wire.session.command({"#1J:6000", "J:6000"}, false);
                }),
                HasSubstr("100.00"));
    wire.pass(1.0);
    EXPECT_EQ(wire.card.position(1), 0.0);
    PmacWire lost({}, false); // the position is not known, so the person who types knows best
    lost.session.let_lines_give_power();
    (void)lost.session.command({"#1J=1200"}, false);
    ASSERT_TRUE(lost.run_to_end(20.0));
    EXPECT_NEAR(lost.card.position(1), 1200.0, 2.0);
}

TEST(PmacJogF3, AProgramThatIsTypedIsStoppedAtTheLimits) {
    PmacWire wire;
    (void)wire.session.command({"OPEN PROG 5", "CLEAR", "LINEAR ABS TA200 TS50 F10 X200", "CLOSE", "&1B5R"},
                               true);
    ASSERT_TRUE(wire.run_to_end(60.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_THAT(wire.session.status().message, HasSubstr("X is beyond its limit"));
    EXPECT_NEAR(wire.degrees(0), 90.0, 2.0);
}

TEST(PmacJogF3, ThatIsTypedAndEndsAtALimitOfTheCardIsToldSo) {
    PmacWire wire({}, true, "XYZA", {}, "I113=1200\n");
    (void)wire.session.command({"#1J=3000"}, false);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_EQ(wire.session.status().message, "motor 1 reached a limit of the card");
    wire.pass(1.0);
    (void)wire.session.command({"#2J=111"}, false); // another motor's move is none of its
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    (void)wire.session.command({"#1J=4000"}, false);
    ASSERT_TRUE(wire.run_to_end(20.0));
    EXPECT_EQ(wire.session.status().message, "motor 1 is at a limit of the card");
    wire.pass(1.0);
    wire.session.jog(jog_of(0, -5.0, 5.0), wire.now); // the way back is free
    ASSERT_TRUE(wire.run_to_end(20.0));
    wire.pass(0.5);
    EXPECT_NEAR(wire.degrees(0), 5.0, 0.5);
}

TEST(PmacJogF2, EndsWhenNobodyHoldsTheKey) {
    PmacWire wire;
    wire.session.jog(jog_of(0, 60.0, 5.0, 0.3), wire.now);
    wire.pass(0.25);
    wire.session.jog(jog_of(0, 5.0, 5.0, 0.3), wire.now); // held
    wire.pass(0.25);
    EXPECT_EQ(wire.state(), drivers::DriverState::running) << wire.session.status().message;
    EXPECT_FALSE(wire.standing());
    ASSERT_TRUE(wire.run_to_end(2.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped) << wire.session.status().message;
    EXPECT_LT(wire.degrees(0), 5.0);
    EXPECT_TRUE(wire.powered());
}

/// Renewed as a window does, a second ahead, until it is refused: what was said.
std::string held_to_the_end(PmacWire& wire, const drivers::Jog& jog) {
    for (int n = 0; n < 3000; ++n) {
        if (const std::string why = refusal([&] { wire.session.jog(jog, wire.now); }); !why.empty()) {
            (void)wire.run_to_end(2.0);
            return why;
        }
        wire.pass(0.016);
    }
    return "";
}

TEST(PmacJog, ThatIsHeldEndsAtALimit) {
    PmacWire wire; // with limits of 90 degrees
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    ASSERT_TRUE(wire.run_to_end(60.0));
    EXPECT_THAT(held_to_the_end(wire, jog_of(0, 25.0, 25.0, 0.1)), HasSubstr("X would exceed its limits"));
    EXPECT_NEAR(wire.degrees(0), 90.0, 0.2);
    wire.pass(0.5);
    EXPECT_NE(wire.state(), drivers::DriverState::alarm) << wire.session.status().message;
    EXPECT_TRUE(wire.powered());
    EXPECT_THAT(refusal([&] { wire.session.jog(jog_of(0, 5.0, 5.0), wire.now); }), HasSubstr("limits"));
}

TEST(PmacJog, OfSeveralAxesKeepsItsDirectionWhenOneIsTooFast) {
    PmacWire wire;
    drivers::Jog both = jog_of(0, 20.0, 20.0);
    both.way[1] = 0.25 * both.way[0];
    wire.session.jog(both, wire.now);
    wire.pass(2.0);
    EXPECT_GT(wire.degrees(0), 5.0);
    EXPECT_NEAR(wire.degrees(1), 0.25 * wire.degrees(0), 0.2);
    ASSERT_TRUE(wire.run_to_end(20.0));
}

TEST(PmacJog, ThatIsRenewedCountsFromWhereTheMotorIs) {
    PmacWire wire; // with limits of 90 degrees
    for (int n = 0; n < 120; ++n) {
        wire.session.jog(jog_of(0, 30.0, 5.0, 0.1), wire.now);
        wire.pass(0.016);
    }
    EXPECT_GT(wire.degrees(0), 5.0);
    EXPECT_LT(wire.degrees(0), 12.0);
    ASSERT_TRUE(wire.run_to_end(2.0));
    EXPECT_LT(wire.degrees(0), 13.0);
}

TEST(PmacJogF2, OfSeveralAxesTheOneThatIsLetGoOfBrakes) {
    PmacWire wire;
    drivers::Jog both = jog_of(0, 5.0, 5.0, 0.1);
    both.way[1] = both.way[0];
    for (int n = 0; n < 60; ++n) {
        wire.session.jog(both, wire.now);
        wire.pass(0.016);
    }
    for (int n = 0; n < 60; ++n) {
        wire.session.jog(jog_of(0, 5.0, 5.0, 0.1), wire.now);
        wire.pass(0.016);
    }
    EXPECT_LT(std::abs(wire.card.speed(2)), 1.0);
    EXPECT_LT(wire.degrees(1), 6.5);
    EXPECT_GT(wire.degrees(0), 8.0);
    ASSERT_TRUE(wire.run_to_end(2.0));
}

TEST(PmacJog, LeavesNoLimits) {
    PmacWire wire;
    EXPECT_THAT(refusal([&] { wire.session.jog(jog_of(1, 91.0, 5.0), wire.now); }), HasSubstr("limits"));
    wire.session.jog(jog_of(1, 2.0, 5.0), wire.now);
    ASSERT_TRUE(wire.run_to_end(20.0));
    wire.pass(0.5);
    EXPECT_THAT(refusal([&] { wire.session.jog(jog_of(1, -93.0, 5.0), wire.now); }), HasSubstr("limits"));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    EXPECT_NE(refusal([&] { wire.session.jog(jog_of(1, 0.0, 5.0), wire.now); }), "");
}

TEST(PmacSession, HomingEndsWhereThereCanBeNoFlagAnyMore) {
    PmacWire wire({}, false, "XYZA", {}, "I902=0\n");
    wire.session.enable(wire.now);
    ASSERT_TRUE(wire.run_until([&] { return wire.session.enabled(); }, 2.0));
    wire.session.home(wire.now);
    ASSERT_TRUE(wire.run_to_end(120.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_THAT(wire.session.status().message, HasSubstr("motor 1 moved 2"));
    EXPECT_TRUE(wire.standing());
    EXPECT_LT(std::abs(wire.card.position(1)) / 120.0, 260.0);
}

TEST(PmacHome, IsFoundAgainFromBehindTheFlag) {
    for (const std::string& setup :
         {std::string("I123=1.2\nI223=2.22\nI323=1.5\nI423=1.5\n"),
          std::string("I123=-1.2\nI223=-2.22\nI323=-1.5\nI423=-1.5\nI902=2\nI907=2\nI912=2\nI917=2\n")}) {
        PmacWire wire({}, false, "XYZA", {}, setup);
        wire.session.enable(wire.now);
        ASSERT_TRUE(wire.run_until([&] { return wire.session.enabled(); }, 2.0));
        if (setup.find('-') != std::string::npos) { // its flags are behind it
            (void)wire.session.command({"#1J=9000#2J=9000#3J=9000#4J=9000"}, false);
            ASSERT_TRUE(wire.run_to_end(90.0));
            wire.pass(0.5);
        }
        wire.session.home(wire.now);
        ASSERT_TRUE(wire.run_to_end(120.0));
        ASSERT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
        for (const double side : {16.0, -16.0}) {
            drivers::Jog all = jog_of(0, side, 5.0);
            all.way.setConstant(all.way[0]);
            wire.session.jog(all, wire.now);
            ASSERT_TRUE(wire.run_to_end(20.0));
            wire.pass(0.5);
            wire.session.home(wire.now);
            double farthest = 0.0;
            while (wire.state() == drivers::DriverState::running) {
                wire.step();
                farthest = std::max(farthest, std::abs(wire.degrees(0)));
            }
            wire.pass(0.5);
            EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
            EXPECT_TRUE(wire.session.position_known());
            EXPECT_LT(farthest, 17.0) << side;
            EXPECT_NEAR(wire.card.variable('I', 122), 32.0, 1e-6);
        }
    }
}

} // namespace
} // namespace millwright::pmac::internal
