// F2: the guard in the card that stops the motors when the computer falls silent, and everything that could
// switch it off without a word. In computed time, with the emulated card.
#include "core/pmac/driver/guard_rules.h"
#include "core/pmac/driver/pmac_file.h"
#include "core/pmac/emulator/motion_program.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::pmac {
namespace {

using test::jog_of;
using test::PmacWire;
using test::refusal;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// Everything that stops the guard, misleads it, or keeps the card from looking after it.
const std::vector<std::string> weakening{"I5=0",
                                         "I5=1",
                                         "i 5 = 0",
                                         "I5=4",
                                         "I5=$0",
                                         "I5=*",
                                         "I5=P1",
                                         "I4..6=0",
                                         "I0..99=*",
                                         "P7=1 I5=0",
                                         "I(5)=0",
                                         "I(P1+4)=0",
                                         "I8=255",
                                         "I8=Q1",
                                         "I10=8388607",
                                         "DISABLE PLC 31",
                                         "dis plc31",
                                         "DISABLE PLC 0..31",
                                         "DISPLC1,31",
                                         "DISABLE PLC 30..31,2",
                                         "OPEN PLC 31",
                                         "OPEN PLC31 CLEAR",
                                         "P1001=0",
                                         "P$3E9=0",
                                         "P(1001)=0",
                                         "P1..1023=0",
                                         "P1002=8388607",
                                         "P1003=5",
                                         "M1000->*",
                                         "M1000->Y:$C003,8,16",
                                         "M1001=0",
                                         "M1..1023=0",
                                         "CMD\"I5=0\"",
                                         "CMD\"DISABLE PLC 31\"",
                                         "CMD^D",
                                         "WX:$1000,0",
                                         "wy $13E8,$0",
                                         "WL:$13E8,1,2",
                                         "WX4096,0",
                                         "WDP:$1000,0",
                                         "WX:$787,$D,1",
                                         "WY:$783,1",
                                         "WY:$73F,1,2",
                                         "CMD\"WX:$1000,0\"",
                                         "WX:(P1),0",
                                         "WY:$FFFFFF,0",
                                         "M50->L:$13E8",
                                         "m50 -> x:$1000,0,24",
                                         "M50->DP:$1000",
                                         "M50->D:$C",
                                         "M50->L:5096",
                                         "CMD\"M50->L:$13E8\"",
                                         "M50->Y:$0,0",
                                         "M1->* M50->TWS:$1000",
                                         "M50->L:(P1)",
                                         "M1..60->L:$13E8",
                                         "M161->L:$13E8",
                                         "M61->D:$28",
                                         "M140..170->D:$28",
                                         "M161->D:$200",
                                         "M161=5",
                                         "M100..199=0",
                                         "M(160+1)=5",
                                         "M(P1)=5",
                                         "M(161)=5",
                                         "CMD\"M161=5\"",
                                         "IF(P9=1)CMD\"(\"ENDIF P1002=M1000",
                                         "IF(P9=1 P1002=M1000",
                                         "P7=(P8 I5=0",
                                         "IF(P9=1)CMD\"IF(P8=1)I5=0\"",
                                         "P7=SIN(CMD\"I5=0\")",
                                         "I102=$13E8",
                                         "I802=5096",
                                         "I3202=$13E8",
                                         "I102=P1",
                                         "I100..199=1",
                                         "I202=$113E8",
                                         "I102=$73F",
                                         "I125=$1313E8",
                                         "I425=M1",
                                         "I125=$0"};

TEST(PmacGuardRules, FindWhatWeakensTheGuardWhereverItStandsInALine) {
    for (const std::string& line : weakening) {
        EXPECT_NE(guard_refusal(line), "") << line;
        EXPECT_NE(guard_refusal("IF(P1=1) " + line), "") << line;
    }
    for (const char* const line : {"I5",
                                   "I5=2",
                                   "I5=3",
                                   "I5=$2",
                                   "I8=0",
                                   "I50=0",
                                   "I105=0",
                                   "I130=5",
                                   "I102=$C003",
                                   "I102=49155",
                                   "I202=$1C002",
                                   "I502=$7F0",
                                   "I102=*",
                                   "I100..199=*",
                                   "I902=10",
                                   "I302",
                                   "I125=$13C000",
                                   "P1001",
                                   "M1000->",
                                   "P1=P1001",
                                   "P999=0",
                                   "P1007=0",
                                   "P(Q1)=3",
                                   "IF(I5=0)",
                                   "IF(P9=1)CMD\"(\"ENDIF P7=M1000",
                                   "CMD\"IF(I5=0)\"",
                                   "IF((P1=1)AND(P1001=1))SEND\")\"",
                                   "WHILE(P1001=1)",
                                   "DISABLE PLC 1..30",
                                   "ENABLE PLC 31",
                                   "OPEN PLC 3",
                                   "LIST PLC 31",
                                   "OPEN PROG 31",
                                   "CIRCLE1 X10 Y10 I(P5) J5",
                                   "CMD^A",
                                   "WX:$786,$D,$43",
                                   "WY:$724,$5007F0",
                                   "WY:$D300,$123456",
                                   "RHX:$1000,8",
                                   "M1023->X:$0,0,24",
                                   "M39->X:$3,15",
                                   "M36->X:$C000,22",
                                   "M151->DP:$D201",
                                   "M154->Y:$D200,0",
                                   "M40->Y:$724,0,24",
                                   "M50->*",
                                   "M161->D:$28",
                                   "P1=M(P2)",
                                   "M162..164->D:$2B",
                                   "M140->Y:$814,0",
                                   "M133->X:$3D,13",
                                   "P1=M161",
                                   "M160=5",
                                   "M50->",
                                   "#1->X",
                                   "X10 W5",
                                   "W(P1) F5",
                                   "WHILE(P1<3) WAIT",
                                   "X10 F5"}) {
        EXPECT_EQ(guard_refusal(line), "") << line;
    }
    for (const char* const line : {"I3=1", "I1..4=0", "P1=2 I9=*", "I(6)=0", "CMD\"I4=0\""}) {
        EXPECT_TRUE(sets_handshake(line)) << line;
    }
    for (const char* const line : {"I3", "I13=1", "I5=2", "I10..99=0", "IF(I3=2)"}) {
        EXPECT_FALSE(sets_handshake(line)) << line;
    }
}

/// What joint 1 goes on, degrees, when the computer says nothing any more for 8 s.
double runs_on_when_frozen(PmacWire& wire) {
    const double before = wire.degrees(0);
    wire.card.advance(8.0);
    return std::abs(wire.degrees(0) - before);
}

constexpr double braking_deg = 1.0; // 5 degrees/s, 50 ms unheard, and what it takes to stop

TEST(PmacLinkGuardF2, NoTypedLineSwitchesItOff) {
    for (const std::string& line : weakening) {
        PmacWire wire;
        EXPECT_THAT(refusal([&] { (void)wire.session.command({line}, false); }),
                    HasSubstr("would weaken the guard"))
            << line;
        wire.pass(0.5);
        wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
        wire.pass(1.5);
        ASSERT_FALSE(wire.standing()) << line;
        EXPECT_LT(runs_on_when_frozen(wire), braking_deg) << line;
        EXPECT_TRUE(wire.standing()) << line;
    }
}

TEST(PmacLinkGuardF2, NoFileOfSettingsSwitchesItOff) {
    std::string text;
    for (const std::string& line : weakening) {
        text += line.starts_with("OPEN") || line.starts_with("CMD") ? "" : line + "\n";
    }
    const PmacFile file = read_pmac_file("I130=700\n" + text + "P7=3", "thesis.ini");
    ASSERT_EQ(file.lines.size(), 2u);
    EXPECT_EQ(file.left_out, 0);
    EXPECT_EQ(to_text(file.omissions.front()),
              "thesis.ini:2:1: I5=0 is skipped: it would weaken the guard that stops the motors when the "
              "connection is lost (the guard is PLC 31, which runs only with I5 = 2 or 3)");
    PmacWire wire({}, false);
    std::vector<std::string> lines;
    for (const PmacFile::Line& line : file.lines) {
        lines.push_back(line.text);
    }
    (void)wire.session.load(lines);
    wire.pass(1.0);
    EXPECT_THAT(wire.session.protections_off().value(), Not(Contains(HasSubstr("PLC 31"))));
    wire.session.enable(wire.now);
    wire.pass(0.5);
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    wire.pass(1.5);
    ASSERT_FALSE(wire.standing());
    EXPECT_LT(runs_on_when_frozen(wire), braking_deg);
}

// A buffer without one of its lines is another program.
TEST(PmacLinkGuardF2, AFileWithAProgramThatSwitchesItOffIsRefused) {
    for (const char* const program : {"OPEN PLC 31\nCLEAR\nCLOSE\n",
                                      "\nOPEN PROG 1 CLEAR\nX10\nI5=0\nCLOSE\n",
                                      "OPEN PLC 2\nCMD^D\nCLOSE\n"}) {
        EXPECT_THAT(refusal([&] { (void)read_pmac_file(program, "a.ini"); }),
                    testing::AllOf(HasSubstr("a.ini:"), HasSubstr("would weaken the guard")))
            << program;
    }
}

TEST(PmacLinkGuardF2, NoProgramThatIsSentSwitchesItOff) {
    PmacWire wire;
    EXPECT_THAT(refusal([&] {
                    wire.session.start({"INC", "X10 F5", "I5=0", "X70"}, wire.now);
                }),
                HasSubstr("'I5=0' would weaken the guard"));
    EXPECT_THAT(refusal([&] {
                    wire.session.start({"INC", "CMD\"I3=0\"", "X70"}, wire.now);
                }),
                HasSubstr("handshake"));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    const auto faults = motion_program_faults("INC\nX10 F5\nDISABLE PLC 31\nI6=0\nX70\n", "a.pmc");
    ASSERT_EQ(faults.size(), 2u);
    EXPECT_THAT(to_text(faults.front()), HasSubstr("a.pmc:3: 'DISABLE PLC 31' would weaken the guard"));
    EXPECT_THAT(to_text(faults.back()), HasSubstr("a.pmc:4: 'I6=0' would change the handshake"));
}

/// Of a program that is in the card's memory, and has gone 2 degrees before that line.
std::string program_with(const std::string& line) {
    return "OPEN PROG 7\nCLEAR\nINC\nLINEAR\nFRAX(X)\nF5\nX2\n" + line + "\nX2\nX2\nX70\nCLOSE\n";
}

// The guard took each scan of it for a sign of life: joint 1 went on without an end.
TEST(PmacLinkGuardF2, AParenthesisInQuotedTextHidesNothingFromIt) {
    const std::string program = "OPEN PLC 5\nCLEAR\nIF(P9=1)CMD\"(\"ENDIF P1002=M1000\nCLOSE\n";
    EXPECT_THAT(refusal([&] { (void)read_pmac_file(program, "a.ini"); }),
                testing::AllOf(HasSubstr("a.ini:3:"), HasSubstr("P1000 to P1006 are reserved")));
    PmacWire wire;
    wire.session.let_lines_give_power();
    EXPECT_THAT(refusal([&] {
                    (void)wire.session.command(
                        {"OPEN PLC 5", "CLEAR", "IF(P9=1)CMD\"(\"ENDIF P1002=M1000", "CLOSE"}, false);
                    wire.pass(0.5);
                    (void)wire.session.command({"ENABLE PLC 5"}, false);
                }),
                HasSubstr("would weaken the guard"));
    wire.pass(0.5);
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    wire.pass(1.5);
    ASSERT_FALSE(wire.standing());
    EXPECT_LT(runs_on_when_frozen(wire), braking_deg);
}

// The content of the card's memory is unknown here.
TEST(PmacLinkGuardF2, AProgramOfTheCardThatSwitchesItOffEndsInAlarm) {
    for (const char* const line :
         {"I5=0", "DISABLE PLC31", "P(1000+1)=0", "P1001=0", "I8=255", "CMD^D", "CMD\"OPEN PLC 31\""}) {
        PmacWire wire({}, true, "XYZA", {}, program_with(line));
        (void)wire.session.command({"&1B7R"}, false);
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 4.0)) << line;
        EXPECT_THAT(wire.session.status().message, HasSubstr("the guard in the card is not running")) << line;
        wire.pass(0.3);
        EXPECT_FALSE(wire.powered()) << line;
        EXPECT_LT(wire.degrees(0), 5.0) << line;
    }
    PmacWire wire({}, true, "XYZA", {}, program_with("CMD\"M1000->*\"")); // its clock stops: it acts at once
    (void)wire.session.command({"&1B7R"}, false);
    ASSERT_TRUE(wire.run_until([&] { return !wire.powered(); }, 4.0));
    wire.pass(0.3);
    EXPECT_LT(wire.degrees(0), 5.0);
}

TEST(PmacLinkGuardF2, WithoutItMotorsGetNoPowerAndItIsListed) {
    PmacWire wire({}, false, "XYZA", {}, "OPEN PLC 5\nCLEAR\nI5=0\nCLOSE\n");
    EXPECT_THAT(wire.session.protections_off().value(), Not(Contains(HasSubstr("PLC 31"))));
    wire.session.let_lines_give_power();
    (void)wire.session.command({"ENABLE PLC 5"}, false);
    wire.pass(1.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    EXPECT_THAT(wire.session.protections_off().value(),
                Contains(HasSubstr("the guard in the card is not running")));
    EXPECT_THAT(refusal([&] { wire.session.enable(wire.now); }),
                HasSubstr("the guard in the card is not running"));
    wire.session.closed();
    wire.come_back(); // which writes it anew
    EXPECT_THAT(wire.session.protections_off().value(), Not(Contains(HasSubstr("PLC 31"))));
    wire.session.enable(wire.now);
    wire.pass(0.5);
    EXPECT_TRUE(wire.powered());
}

// It disarms itself when it fires, which is no fault of the guard.
TEST(PmacLinkGuardF2, MotorsGetTheirPowerBackAtOnceAfterItHasFired) {
    PmacWire wire;
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    wire.pass(1.0);
    wire.card.advance(1.0); // no sign of life arrives
    EXPECT_FALSE(wire.powered());
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 1.0));
    wire.pass(0.5);
    wire.session.reset(wire.now);
    EXPECT_EQ(refusal([&] { wire.session.enable(wire.now); }), "");
    wire.pass(0.5);
    EXPECT_TRUE(wire.powered());
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
}

// No sign of life is heard while a buffer is open.
TEST(PmacLinkGuardF2, NoBufferIsOpenedBehindALineThatMoves) {
    for (const std::vector<std::string>& lines :
         {std::vector<std::string>{"#1J:9000", "OPEN PROG 3", "CLEAR"},
          {"P1=5", "&1B7R", "CLOSE", "OPEN PLC 2"}}) {
        PmacWire wire;
        EXPECT_THAT(refusal([&] { (void)wire.session.command(lines, false); }),
                    HasSubstr("would disarm the guard"));
    }
    PmacWire wire;
    (void)wire.session.command({"P1=5",
                                "CLOSE",
                                "&1#1->120X",
                                "OPEN PROG 3 CLEAR",
                                "X10",
                                "CLOSE",
                                "#1P",
                                "OPEN PROG 4 CLEAR",
                                "X1"},
                               false);
    wire.pass(2.0);
    EXPECT_EQ(wire.session.status().answer.state, drivers::CommandAnswer::State::done);
}

// The driver sees it stand and would take it for a machine at rest.
TEST(PmacLinkGuardF2, AProgramOfAnotherCoordinateSystemThatWaitsIsGuarded) {
    PmacWire wire(
        {},
        true,
        "XYZA",
        {},
        "&1#1->0\n&2#1->120X\n&1OPEN PROG 7\nCLEAR\nDWELL4000\nINC\nLINEAR\nFRAX(X)\nF10\nX80\nCLOSE\n");
    (void)wire.session.command({"&2B7R"}, false);
    wire.pass(2.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle);
    ASSERT_TRUE(wire.card.program_runs(2));
    EXPECT_LT(runs_on_when_frozen(wire), 0.1);
}

TEST(PmacLinkGuardF2, ThatStaysArmedIsDisarmedBeforeTheLinkIsDropped) {
    PmacWire wire({}, true, "XYZA", {}, "OPEN PLC 5\nCLEAR\nP7=1\nCLOSE\n", nullptr, Parting::keeps_power);
    (void)wire.session.command({"ENABLE PLC 5"}, false);
    wire.pass(1.0);
    EXPECT_EQ(wire.card.variable('P', 1001), 1.0);
    wire.leave();
    wire.card.advance(1.0);
    EXPECT_TRUE(wire.powered());
    EXPECT_EQ(wire.card.variable('P', 1001), 0.0);
}

// Whoever leaves as soon as a command is done leaves while the disarming is still to be sent.
TEST(PmacLinkGuardF2, IsDisarmedBeforeTheLinkIsDroppedJustAfterACommand) {
    for (int later = 0; later < 60; ++later) { // steps of 2 ms
        PmacWire wire({}, true, "XYZA", {}, {}, nullptr, Parting::keeps_power);
        (void)wire.session.command({"#1J/"}, false);
        ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::idle; }, 5.0));
        wire.pass(0.002 * later);
        wire.leave();
        wire.card.advance(1.0);
        EXPECT_TRUE(wire.powered()) << later;
    }
}

/// How long the motors keep their power after the last word, s.
double power_after_the_last_word(const std::string& setup) {
    PmacWire wire({}, true, "XYZA", {}, setup);
    wire.session.jog(jog_of(0, 80.0, 5.0), wire.now);
    wire.pass(1.5);
    EXPECT_FALSE(wire.standing()) << setup;
    const double begin = wire.card.time();
    while (wire.powered() && wire.card.time() < begin + 8.0) {
        wire.card.advance(0.001);
    }
    return wire.card.time() - begin;
}

TEST(PmacLinkGuardF2, CountsTimeInTheServoCyclesThatTheCardHas) {
    for (const char* const servo_time : {"I10=1856853\n", "I10=3713707\n", "I10=7427414\n"}) {
        EXPECT_LE(power_after_the_last_word(servo_time), 0.100) << servo_time;
    }
    PmacWire wire({}, false, "XYZA", {}, "I10=1000\n");
    EXPECT_EQ(wire.state(), drivers::DriverState::alarm);
    EXPECT_THAT(wire.session.status().message, HasSubstr("I10 = 1000, which is not a valid servo time"));
}

// Both ends see the other's words late, as on a busy computer. The power that a line gave was taken again at
// once, and that was not reported.
TEST(PmacLinkGuardF2, EveryLineIsASignOfLifeWhereEachWordTakesLong) {
    PmacWire wire({}, false);
    wire.session.let_lines_give_power();
    for (const char* const line : {"#1J/", "#2J/", "#1J/#2J/#3J/#4J/"}) {
        (void)wire.session.command({line}, false);
        double quietest = 0.0; // without a word that the guard counts, s of the card
        double heard = wire.card.time();
        double before = wire.card.variable('P', 1002);
        for (int word = 0; word < 120; ++word) {
            wire.step(0.009);
            if (const double now = wire.card.variable('P', 1002); now > before || now < before) {
                before = now;
                heard = wire.card.time();
            }
            const bool armed = wire.card.variable('P', 1001) > 0.5;
            quietest = armed ? std::max(quietest, wire.card.time() - heard) : quietest;
        }
        EXPECT_LT(quietest, 0.04) << line;
        EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
        EXPECT_TRUE(wire.card.enabled(1)) << line;
    }
    EXPECT_TRUE(wire.card.enabled(2));
    EXPECT_TRUE(wire.card.enabled(4));
}

// Questions were answered by "open loop" then, as if nothing had happened.
TEST(PmacLinkGuardF2, PowerThatItTookBehindALineIsTold) {
    PmacWire wire({}, false);
    wire.session.let_lines_give_power();
    (void)wire.session.command({"#1J/"}, false);
    ASSERT_TRUE(wire.run_until([&] { return wire.card.enabled(1); }, 1.0));
    wire.card.advance(0.3); // no sign of life arrives
    EXPECT_FALSE(wire.card.enabled(1));
    ASSERT_TRUE(wire.run_until([&] { return wire.state() == drivers::DriverState::alarm; }, 1.0));
    EXPECT_THAT(wire.session.status().message, HasSubstr("received nothing from this computer for 50 ms"));
    EXPECT_NE(wire.session.status().answer.state, drivers::CommandAnswer::State::pending);
    // A mark of then is no reason to refuse what comes after.
    wire.pass(0.5);
    wire.session.reset(wire.now);
    (void)wire.session.command({"#1J/"}, false);
    wire.pass(1.0);
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_TRUE(wire.card.enabled(1));
}

TEST(PmacLinkGuardF2, AMotionOfALineThatItCutShortIsNotCalledDone) {
    PmacWire wire;
    (void)wire.session.command({"#1J:2000"}, false);
    wire.pass(0.5);
    ASSERT_FALSE(wire.standing());
    for (int ms = 0; ms < 100 && wire.card.variable('P', 1000) >= 0.0; ++ms) {
        wire.card.advance(0.001); // until it aborts; it takes no power yet
    }
    EXPECT_TRUE(wire.powered());
    ASSERT_TRUE(wire.run_to_end(10.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::stopped);
    EXPECT_THAT(wire.session.status().message,
                HasSubstr("the card stopped its motors: the card received nothing"));
    wire.pass(2.0); // the servo settles
    EXPECT_TRUE(wire.standing());
    EXPECT_LT(wire.card.position(1), 1900.0);
}

// It waited 50 ms for the rest of an error that had come whole, which the guard took for silence.
TEST(PmacLinkGuardF2, ARefusedLineIsNoSilence) {
    PmacWire wire;
    (void)wire.session.command({"#1J:2000", "UNKNOWN"}, true);
    ASSERT_TRUE(wire.run_until(
        [&] { return wire.session.status().answer.state != drivers::CommandAnswer::State::pending; }, 2.0));
    EXPECT_THAT(wire.session.status().answer.text, HasSubstr("ERR003, no such command"));
    ASSERT_TRUE(wire.run_to_end(30.0));
    EXPECT_EQ(wire.state(), drivers::DriverState::idle) << wire.session.status().message;
    EXPECT_NEAR(wire.card.position(1), 2000.0, 2.0) << "the motion was cut short";
}

} // namespace
} // namespace millwright::pmac
