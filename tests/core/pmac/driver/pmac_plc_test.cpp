// F2: PLC programs of the card that move motors, motion that something else set going, and stops, which pass
// in every state. In computed time.
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac::internal {
namespace {

using test::jog_of;
using test::PmacWire;
using test::refusal;
using testing::HasSubstr;

/// Jogs motor 1 in each scan.
const std::string jogging_plc = "OPEN PLC 6\nCLEAR\nCMD\"#1J+\"\nCLOSE\n";

TEST(PmacPlcF2, NoneIsEnabledWithoutPowerThatAPersonGave) {
    for (const std::string line : {"ENABLE PLC 6",
                                   "ena p l c 1..6",
                                   "P1=1 ENAPLC6",
                                   "ENABLE PLC 31,6",
                                   "E NABLE PLC 6",
                                   "ENABLE PLC 0"}) {
        for (const bool file : {false, true}) {
            PmacWire wire({}, false, "XYZA", {}, jogging_plc);
            const auto give = [&] {
                (void)(file ? wire.session.load({"P1=2", line}) : wire.session.command({line}, false));
            };
            EXPECT_THAT(refusal(give), HasSubstr("could enable motors")) << line;
            wire.pass(1.0);
            EXPECT_FALSE(wire.powered()) << line;
            EXPECT_NEAR(wire.degrees(0), 0.0, 0.1) << line;
        }
    }
    PmacWire wire({}, false);
    for (const std::string line : {"ENABLE PLC 31", "DISABLE PLC 6", "LIST PLC 6"}) {
        EXPECT_EQ(refusal([&] { (void)wire.session.command({line}, false); }), "") << line;
        wire.pass(0.5);
    }
    EXPECT_EQ(refusal([&] {
                  (void)wire.session.command({"OPEN PLC 6 CLEAR", "ENABLE PLC 7", "CLOSE"}, false);
              }),
              "");
    wire.pass(0.5);
    wire.session.let_lines_give_power();
    EXPECT_EQ(refusal([&] { (void)wire.session.command({"ENABLE PLC 6"}, false); }), "");
}

// A program is one, too: what it does by CMD is done without a look at the loops.
TEST(PmacPlcF2, NoProgramIsRunWhereSomeMotorHasNoPower) {
    PmacWire wire({}, true, "XYZA", {}, "OPEN PROG 7\nCLEAR\nCMD\"#2J+\"\nCLOSE\n&2#1->120X\n&1");
    (void)wire.session.command({"#2K"}, false);
    wire.pass(0.5);
    for (const std::string line : {"&2B7R", "&2B7 S", "&2 b7r"}) {
        EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }),
                    HasSubstr("could enable motors"))
            << line;
        wire.pass(0.5);
        EXPECT_FALSE(wire.card.enabled(2)) << line;
    }
}

// "The motors are disabled" was said while it enabled them again.
TEST(PmacPlcF2, IsSwitchedOffBeforeTheLinkIsDropped) {
    for (const Parting parting : {Parting::takes_power, Parting::as_found, Parting::keeps_power}) {
        PmacWire wire({}, false, "XYZA", {}, jogging_plc, nullptr, parting);
        wire.session.let_lines_give_power();
        (void)wire.session.command({"ENABLE PLC 6"}, false);
        ASSERT_TRUE(wire.run_until([&] { return wire.degrees(0) > 0.5; }, 5.0));
        wire.leave();
        EXPECT_EQ(wire.session.farewell(), "");
        wire.card.advance(2.0); // no host is connected
        const double at = wire.degrees(0);
        wire.card.advance(2.0);
        EXPECT_NEAR(wire.degrees(0), at, 0.1);
        EXPECT_EQ(wire.powered(), parting == Parting::keeps_power);
    }
}

TEST(PmacPlcF2, IsSwitchedOffByAStopAKillAndAnAlarm) {
    for (const std::string how : {"stop", "alarm", "#1K", "A", "#1J/", "^K", "^A", "^D", "DISABLE PLC 6"}) {
        PmacWire wire({}, true, "XYZA", {}, jogging_plc);
        wire.session.let_lines_give_power();
        (void)wire.session.command({"ENABLE PLC 6"}, false);
        ASSERT_TRUE(wire.run_until([&] { return wire.degrees(0) > 0.5; }, 5.0));
        if (how == "stop") {
            wire.session.stop(wire.now);
        } else if (how == "alarm") {
            wire.session.emergency_stop(wire.now);
        } else {
            EXPECT_EQ(refusal([&] { (void)wire.session.command({how}, false); }), "") << how;
        }
        if (how == "^D" || how == "DISABLE PLC 6") { // stops no motor
            wire.pass(0.5);
            (void)wire.session.command({"#1J/"}, false);
        }
        wire.pass(2.0);
        EXPECT_TRUE(wire.standing()) << how;
        const double at = wire.degrees(0);
        wire.pass(1.0);
        EXPECT_NEAR(wire.degrees(0), at, 0.1) << how;
        const bool kills = how == "alarm" || how == "#1K" || how == "^K";
        EXPECT_EQ(wire.card.enabled(1), !kills) << how;
        EXPECT_THAT(wire.session.protections_off().value(),
                    testing::Not(testing::Contains(HasSubstr("PLC 31"))))
            << how;
    }
}

/// Sent by somebody else before the link is made.
struct Moving : PmacWire {
    Moving()
        : PmacWire({},
                   false,
                   "XYZA",
                   {},
                   "I122=0.06\n#1J/\n#2J/\n#3J/\n#4J/\n#1J+\n",
                   nullptr,
                   Parting::as_found) {
        pass(0.2);
        EXPECT_FALSE(standing());
    }
};

// docs/user/arm.md promises it.
TEST(PmacStopsF2, PassWhileSomethingElseMovesTheMotors) {
    for (const std::string line : {"A", "&1A", "#1K", "K", "#1J/", "J/", "H A", "^A", "^K"}) {
        Moving wire;
        EXPECT_EQ(refusal([&] { (void)wire.session.command({line}, false); }), "") << line;
        wire.pass(2.0);
        EXPECT_TRUE(wire.standing()) << line;
        EXPECT_EQ(wire.card.enabled(1), line.find('K') == std::string::npos) << line;
    }
    Moving wire;
    for (const std::string line : {"DISABLE PLC 6", "^D", "dis plc 1..5,7", "#1P", "I500", "P1"}) {
        EXPECT_EQ(refusal([&] { (void)wire.session.command({line}, false); }), "") << line;
        wire.pass(0.3);
        EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done) << line;
        EXPECT_FALSE(wire.standing()) << line;
    }
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"I130=3000"}, false); }),
                HasSubstr("the motors are moving"));
    EXPECT_THAT(refusal([&] { (void)wire.session.command({"DISABLE PLC 6 #1J:500"}, false); }),
                HasSubstr("the motors are moving"));
}

TEST(PmacStopsF2, AKillOfAProgramThatSomethingElseRunsIsNotLeftToTheCard) {
    PmacWire wire(
        {},
        false,
        "XYZA",
        {},
        "#1J/\n#2J/\n#3J/\n#4J/\nOPEN PROG 7\nCLEAR\nINC\nLINEAR\nFRAX(X)\nF0.5\nX70\nCLOSE\n&1B7R\n",
        nullptr,
        Parting::as_found);
    wire.pass(0.2);
    ASSERT_TRUE(wire.card.program_runs(1));
    ASSERT_FALSE(wire.standing());
    (void)wire.session.command({"#1K"}, false); // the card refuses it while a program runs
    wire.pass(1.0);
    EXPECT_FALSE(wire.powered());
    EXPECT_TRUE(wire.standing());
}

TEST(PmacStopsF2, PassInEachStateOfTheDriver) {
    const auto stopped = [](PmacWire& wire, const std::string& line) {
        EXPECT_EQ(refusal([&] { (void)wire.session.command({line}, false); }), "") << line;
        wire.pass(3.0);
        EXPECT_TRUE(wire.standing()) << line;
        const double at = wire.degrees(0);
        wire.pass(1.0);
        EXPECT_NEAR(wire.degrees(0), at, 0.1) << line;
    };
    for (const std::string line : {"A", "#1K", "#1J/", "^K", "^A"}) {
        PmacWire loading;
        loading.session.start(std::vector<std::string>(200, "INC X1"), loading.now);
        loading.pass(0.05);
        stopped(loading, line);
        PmacWire commanding;
        (void)commanding.session.command({"P1=1", "#1J:9000", "P1=2", "P1=3"}, false);
        commanding.pass(0.01);
        ASSERT_EQ(commanding.session.status().answer.state, drivers::CommandAnswer::State::pending);
        stopped(commanding, line);
        PmacWire jogging;
        jogging.session.jog(jog_of(0, 80.0, 5.0), jogging.now);
        jogging.pass(1.0);
        EXPECT_EQ(refusal([&] { (void)jogging.session.command({"DISABLE PLC 6"}, false); }), "");
        jogging.pass(0.3);
        EXPECT_FALSE(jogging.standing());
        stopped(jogging, line);
    }
    PmacWire alarm;
    alarm.session.emergency_stop(alarm.now);
    alarm.pass(0.5);
    for (const std::string line : {"#1P", "#1K", "DISABLE PLC 6", "^K"}) {
        EXPECT_EQ(refusal([&] { (void)alarm.session.command({line}, false); }), "") << line;
        alarm.pass(0.3);
        EXPECT_NE(alarm.session.status().answer.state, drivers::CommandAnswer::State::pending) << line;
    }
}

} // namespace
} // namespace millwright::pmac::internal
