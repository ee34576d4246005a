#include "core/emulators/grbl/grbl_emulator.h"

#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace millwright::emulators {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// Sends one line and returns everything that came until it was answered or `patience` seconds were over.
std::string answer(GrblEmulator& grbl, const std::string& line, double patience = 60.0) {
    grbl.receive(line + "\n");
    std::string text;
    for (double time = 0.0; time < patience; time += 0.001) {
        grbl.advance(0.001);
        text += grbl.take_output();
        if (text.find("ok\r\n") != std::string::npos || text.find("error:") != std::string::npos) {
            break;
        }
    }
    return text;
}

std::string status(GrblEmulator& grbl) {
    grbl.receive("?");
    return grbl.take_output();
}

void run_until_rest(GrblEmulator& grbl) {
    do {
        grbl.advance(0.01);
    } while (grbl.moving());
}

struct Grbl : testing::Test {
    GrblEmulator grbl;
    Grbl() { EXPECT_EQ(grbl.take_output(), "\r\nGrbl 1.1h ['$' for help]\r\n"); }
};

TEST_F(Grbl, ReportsItsStateAsDocumented) {
    EXPECT_EQ(status(grbl), "<Idle|MPos:0.000,0.000,0.000|FS:0,0|WCO:0.000,0.000,0.000>\r\n");
    EXPECT_EQ(status(grbl), "<Idle|MPos:0.000,0.000,0.000|FS:0,0|Ov:100,100,100>\r\n");
    EXPECT_EQ(status(grbl), "<Idle|MPos:0.000,0.000,0.000|FS:0,0>\r\n");
    EXPECT_EQ(answer(grbl, "$10=2"), "ok\r\n");
    EXPECT_EQ(status(grbl), "<Idle|WPos:0.000,0.000,0.000|Bf:15,128|FS:0,0>\r\n");
}

TEST_F(Grbl, MovesWhereItIsToldAndRemembersIt) {
    EXPECT_EQ(answer(grbl, "G1 X10 Y-5 (there) F600"), "ok\r\n");
    EXPECT_THAT(status(grbl), StartsWith("<Run|"));
    run_until_rest(grbl);
    EXPECT_THAT(status(grbl), StartsWith("<Idle|MPos:10.000,-5.000,0.000|"));
    const Truth truth = grbl.truth();
    ASSERT_EQ(truth.lines.size(), 1u);
    EXPECT_EQ(truth.lines[0].text, "G1X10Y-5F600");
    EXPECT_GT(truth.lines[0].executed, truth.lines[0].accepted);
    EXPECT_NEAR(truth.travelled, std::hypot(10.0, 5.0), 1e-6);
}

TEST_F(Grbl, TakesG53ForAMachinePositionInIncrementalModeToo) {
    for (const char* line : {"G0 X5 Z-5", "G92 X0", "G91 X2", "G53 G0 X1 Z-1"}) {
        EXPECT_EQ(answer(grbl, line), "ok\r\n") << line;
    }
    run_until_rest(grbl);
    EXPECT_EQ(grbl.position(), (std::array{1.0, 0.0, -1.0}));
}

TEST_F(Grbl, TakesTheTimeThatItsAccelerationsAllow) {
    (void)answer(grbl, "G1 X50 F1200");
    const double begin = grbl.time();
    run_until_rest(grbl);
    const double speed = 20.0;
    const double acceleration = 200.0;
    EXPECT_NEAR(grbl.time() - begin, 50.0 / speed + speed / acceleration, 0.03);
}

TEST_F(Grbl, GoesThroughStraightCornersWithoutStopping) {
    for (int n = 1; n <= 100; ++n) {
        EXPECT_EQ(answer(grbl, "G1X" + std::to_string(n) + "F1200"), "ok\r\n");
    }
    run_until_rest(grbl);
    EXPECT_NEAR(grbl.time(), 100.0 / 20.0 + 20.0 / 200.0, 0.1);
}

struct Wrong {
    const char* line;
    int error;
};

class GrblErrors : public testing::TestWithParam<Wrong> {};

TEST_P(GrblErrors, AreNumberedAsDocumented) {
    GrblEmulator grbl;
    (void)grbl.take_output();
    EXPECT_EQ(answer(grbl, GetParam().line), "error:" + std::to_string(GetParam().error) + "\r\n");
    EXPECT_TRUE(grbl.truth().lines.empty());
}

INSTANTIATE_TEST_SUITE_P(All,
                         GrblErrors,
                         testing::Values(Wrong{"10X", 1},
                                         Wrong{"G1X", 2},
                                         Wrong{"G1X-", 2},
                                         Wrong{"$Q", 3},
                                         Wrong{"$999=1", 3},
                                         Wrong{"G1X1F-5", 4},
                                         Wrong{"$110=-1", 4},
                                         Wrong{"$H", 5},
                                         Wrong{"$0=1", 6},
                                         Wrong{"$20=1", 10},
                                         Wrong{"$JX1", 16},
                                         Wrong{"$J=G2X1F100", 16},
                                         Wrong{"G5X1", 20},
                                         Wrong{"A1", 20},
                                         Wrong{"M6", 20},
                                         Wrong{"G17G18", 21},
                                         Wrong{"G1X1", 22},
                                         Wrong{"$J=X1", 22},
                                         Wrong{"G93G1X1", 22},
                                         Wrong{"G1.05", 23},
                                         Wrong{"M3.1", 23},
                                         Wrong{"G0G10X1", 24},
                                         Wrong{"G0G49X1", 24},
                                         Wrong{"X1X2", 25},
                                         Wrong{"G92", 26},
                                         Wrong{"N10000001", 27},
                                         Wrong{"G4", 28},
                                         Wrong{"G10X1", 28},
                                         Wrong{"G10L20P9X1", 29},
                                         Wrong{"G10L2P7X1", 29},
                                         Wrong{"G2G53X1I1F1", 30},
                                         Wrong{"G80X1", 31},
                                         Wrong{"G2Z1I1F1", 32},
                                         Wrong{"G2X10I1F1", 33},
                                         Wrong{"G38.2Z0F1", 33},
                                         Wrong{"G2X10R1F1", 34},
                                         Wrong{"G2X10F1", 35},
                                         Wrong{"G0X1P1", 36},
                                         Wrong{"G43.1X1", 37},
                                         Wrong{"T300", 38}));

TEST_F(Grbl, RefusesALineThatIsTooLong) {
    EXPECT_EQ(answer(grbl, std::string(81, 'G')), "error:11\r\n");
    EXPECT_EQ(answer(grbl, "(" + std::string(100, 'c') + ")G0"), "ok\r\n");
}

TEST_F(Grbl, LosesBytesThatFindItsBufferFull) {
    (void)answer(grbl, "$10=3");
    grbl.receive("!");
    grbl.receive(std::string(130, 'x'));
    EXPECT_EQ(grbl.truth().lost_bytes, 2);
    EXPECT_THAT(status(grbl), HasSubstr("|Bf:15,0|"));
}

TEST_F(Grbl, HoldsByBrakingAndGoesOn) {
    (void)answer(grbl, "G1 X50 F1200");
    grbl.advance(1.0);
    grbl.receive("!");
    EXPECT_THAT(status(grbl), StartsWith("<Hold:1|"));
    grbl.advance(0.3);
    EXPECT_THAT(status(grbl), StartsWith("<Hold:0|"));
    const auto there = grbl.position();
    EXPECT_GT(there[0], 15.0);
    grbl.advance(5.0);
    EXPECT_EQ(grbl.position(), there);
    grbl.receive("~");
    run_until_rest(grbl);
    EXPECT_DOUBLE_EQ(grbl.position()[0], 50.0);
}

TEST_F(Grbl, ReadsNothingWhileItHolds) {
    grbl.receive("!");
    EXPECT_EQ(answer(grbl, "G0X1", 1.0), "");
    grbl.receive("~");
    grbl.advance(0.1);
    EXPECT_EQ(grbl.take_output(), "ok\r\n");
}

TEST_F(Grbl, SaysThatItsPositionIsLostWhenItIsResetInMotion) {
    (void)answer(grbl, "G1 X50 F1200");
    grbl.advance(1.0);
    grbl.receive("\x18");
    EXPECT_EQ(grbl.take_output(), "ALARM:3\r\n\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\n");
    const auto there = grbl.position();
    EXPECT_EQ(answer(grbl, "G0 X0"), "error:9\r\n");
    grbl.advance(1.0);
    EXPECT_EQ(grbl.position(), there);
    EXPECT_EQ(answer(grbl, "$X"), "[MSG:Caution: Unlocked]\r\nok\r\n");
    EXPECT_EQ(answer(grbl, "G0 X0"), "ok\r\n");
}

TEST_F(Grbl, ForgetsItsProgramWhenItIsResetAtRest) {
    (void)answer(grbl, "G1 X50 F1200");
    grbl.advance(1.0);
    grbl.receive("!");
    grbl.advance(1.0);
    grbl.receive("\x18");
    EXPECT_EQ(grbl.take_output(), "\r\nGrbl 1.1h ['$' for help]\r\n");
    grbl.receive("~");
    const auto there = grbl.position();
    grbl.advance(1.0);
    EXPECT_EQ(grbl.position(), there);
}

TEST_F(Grbl, ScalesFeedsRapidsAndTheSpindle) {
    (void)answer(grbl, "M3 S1000");
    (void)answer(grbl, "G1 X100 F600");
    grbl.advance(1.0);
    for (const char* byte : {"\x91", "\x91", "\x94", "\x97", "\x9b"}) {
        grbl.receive(byte);
    }
    grbl.advance(1.0);
    const std::string report = status(grbl);
    EXPECT_THAT(report, HasSubstr("|FS:714,900|"));
    EXPECT_THAT(report + status(grbl), HasSubstr("|Ov:119,25,90|A:S>"));
}

TEST_F(Grbl, TurnsTheSpindleWithinItsSettings) {
    (void)answer(grbl, "$31=100");
    (void)answer(grbl, "M3 S6000");
    EXPECT_THAT(status(grbl), HasSubstr(",1000|")); // $30
    (void)answer(grbl, "S20");
    EXPECT_THAT(status(grbl), HasSubstr(",100|"));
    (void)answer(grbl, "S0");
    EXPECT_THAT(status(grbl), HasSubstr(",0|"));
}

/// As the real one, which keeps them as flags and looks at these once in each pass of its main loop.
TEST_F(Grbl, TakesEqualOverrideBytesThatComeTogetherForOne) {
    (void)status(grbl);
    grbl.receive("\x91\x91\x91\x93\x93\x9a\xa0\xa0");
    grbl.advance(0.1);
    EXPECT_THAT(status(grbl) + status(grbl), HasSubstr("|Ov:111,100,110|A:F>"));
    grbl.receive("\x90\x92"); // the standard first, then less
    grbl.advance(0.1);
    EXPECT_THAT(status(grbl) + status(grbl), HasSubstr("|Ov:90,100,110"));
}

TEST_F(Grbl, JogsAndStopsWhenToldWithoutForgettingItsModes) {
    EXPECT_EQ(answer(grbl, "G91"), "ok\r\n");
    EXPECT_EQ(answer(grbl, "$J=G90 G21 X100 F1200"), "ok\r\n");
    grbl.advance(1.0);
    EXPECT_THAT(status(grbl), StartsWith("<Jog|"));
    EXPECT_EQ(answer(grbl, "G0X1"), "error:9\r\n");
    grbl.receive("\x85");
    grbl.advance(0.3);
    EXPECT_THAT(status(grbl), StartsWith("<Idle|"));
    EXPECT_LT(grbl.position()[0], 30.0);
    EXPECT_THAT(answer(grbl, "$G"), HasSubstr("[GC:G0 G54 G17 G21 G91 G94 M5 M9 T0 F0 S0]"));
}

TEST_F(Grbl, OpensItsDoorAndGoesOnWhenItIsClosed) {
    (void)answer(grbl, "G1 X50 F1200");
    grbl.advance(1.0);
    grbl.set_door(true);
    EXPECT_THAT(status(grbl), StartsWith("[MSG:Check Door]\r\n<Door:2|"));
    grbl.advance(1.0);
    EXPECT_THAT(status(grbl), StartsWith("<Door:1|"));
    grbl.receive("~");
    grbl.set_door(false);
    grbl.advance(1.0);
    EXPECT_THAT(status(grbl), StartsWith("<Door:0|"));
    grbl.receive("~");
    grbl.advance(0.1);
    EXPECT_THAT(status(grbl), StartsWith("<Run|"));
    run_until_rest(grbl);
    EXPECT_DOUBLE_EQ(grbl.position()[0], 50.0);
}

TEST_F(Grbl, ProbesASurface) {
    GrblEmulator probe({.surface = [](double x, double) { return -10.0 + 0.1 * x; }});
    (void)probe.take_output();
    (void)answer(probe, "G0 X10");
    const std::string report = answer(probe, "G38.2 Z-20 F100");
    EXPECT_THAT(report, HasSubstr("[PRB:10.000,0.000,-9.000:1]\r\nok\r\n"));
    EXPECT_EQ(answer(probe, "G38.2 Z-20 F100"), "ALARM:4\r\nok\r\n");
}

TEST_F(Grbl, RaisesAnAlarmWhenAProbeTouchesNothing) {
    const std::string report = answer(grbl, "G38.2 Z-2 F600");
    EXPECT_EQ(report, "ALARM:5\r\n[PRB:0.000,0.000,0.000:0]\r\nok\r\n"); // where one touched last: never yet
    (void)answer(grbl, "$X");
    EXPECT_THAT(answer(grbl, "G38.3 Z-4 F600"), Not(HasSubstr("ALARM")));
}

TEST_F(Grbl, HomesAndThenKeepsToItsTravel) {
    (void)answer(grbl, "$22=1");
    (void)answer(grbl, "$20=1");
    (void)answer(grbl, "$25=3000");
    EXPECT_THAT(answer(grbl, "$H"), EndsWith("ok\r\n"));
    EXPECT_THAT(status(grbl), StartsWith("<Idle|MPos:-1.000,-1.000,-1.000|"));
    EXPECT_EQ(answer(grbl, "$J=X5F100"), "error:15\r\n");
    EXPECT_THAT(answer(grbl, "G0 X-300", 1.0), HasSubstr("ALARM:2\r\n[MSG:Reset to continue]\r\n"));
    EXPECT_EQ(status(grbl), "");
    grbl.receive("\x18");
    EXPECT_THAT(grbl.take_output(), HasSubstr("Grbl 1.1h"));
}

TEST_F(Grbl, TellsWhenHomingFails) {
    (void)answer(grbl, "$22=1");
    grbl.break_limit_switches();
    EXPECT_EQ(answer(grbl, "$H", 120.0),
              "ALARM:9\r\n\r\nGrbl 1.1h ['$' for help]\r\n[MSG:'$H'|'$X' to unlock]\r\n");
}

TEST_F(Grbl, StopsDeadAtALimitSwitch) {
    (void)answer(grbl, "$21=1");
    (void)answer(grbl, "G1 X-50 F1200");
    grbl.advance(1.0);
    grbl.hit_limit_switch();
    EXPECT_THAT(grbl.take_output(), HasSubstr("ALARM:1\r\n[MSG:Reset to continue]\r\n"));
    const auto there = grbl.position();
    EXPECT_EQ(answer(grbl, "$X", 1.0), "");
    EXPECT_EQ(grbl.position(), there);
}

TEST_F(Grbl, ChecksAProgramWithoutMoving) {
    EXPECT_EQ(answer(grbl, "$C"), "[MSG:Enabled]\r\nok\r\n");
    EXPECT_EQ(answer(grbl, "G1 X50 F1200"), "ok\r\n");
    EXPECT_EQ(answer(grbl, "G1 X50 A4"), "error:20\r\n");
    grbl.advance(1.0);
    EXPECT_THAT(status(grbl), StartsWith("<Check|MPos:0.000,"));
    EXPECT_THAT(answer(grbl, "$C"), StartsWith("[MSG:Disabled]\r\nok\r\n"));
    grbl.advance(0.1);
    EXPECT_THAT(status(grbl), StartsWith("<Idle|"));
}

TEST_F(Grbl, SleepsUntilItIsReset) {
    EXPECT_THAT(answer(grbl, "$SLP"), HasSubstr("[MSG:Sleeping]\r\nok\r\n"));
    EXPECT_THAT(status(grbl), StartsWith("<Sleep|"));
    EXPECT_EQ(answer(grbl, "G0X1", 1.0), "");
    grbl.receive("\x18");
    EXPECT_THAT(status(grbl), HasSubstr("to unlock]\r\n<Alarm|"));
}

TEST_F(Grbl, DwellsAndPausesBeforeItAnswers) {
    (void)answer(grbl, "G1 X1 F1200");
    grbl.receive("G4 P2\n");
    grbl.advance(1.9);
    EXPECT_EQ(grbl.take_output(), "");
    grbl.advance(1.0);
    EXPECT_EQ(grbl.take_output(), "ok\r\n");
    EXPECT_EQ(answer(grbl, "M0", 1.0), "");
    EXPECT_THAT(status(grbl), StartsWith("<Hold:0|"));
    grbl.receive("~");
    grbl.advance(0.1);
    EXPECT_EQ(grbl.take_output(), "ok\r\n");
}

TEST_F(Grbl, KeepsOffsetsAndSettingsWithoutPower) {
    const test::ScratchFolder scratch;
    const auto file = scratch / "eeprom";
    {
        GrblEmulator first({.eeprom_file = file});
        (void)first.take_output();
        (void)answer(first, "$110=1234.5");
        (void)answer(first, "G10 L2 P2 X1 Y2 Z3");
        (void)answer(first, "$N0=G55");
        (void)answer(first, "$22=1");
        (void)answer(first, "$20=1");
    }
    GrblEmulator second({.eeprom_file = file});
    EXPECT_THAT(second.take_output(), HasSubstr("to unlock]"));
    (void)answer(second, "$X");
    EXPECT_THAT(answer(second, "$$"), HasSubstr("$110=1234.500\r\n"));
    EXPECT_THAT(answer(second, "$$"), HasSubstr("$20=1\r\n"));
    EXPECT_THAT(answer(second, "$#"), HasSubstr("[G55:1.000,2.000,3.000]"));
    EXPECT_THAT(answer(second, "$RST=*"), HasSubstr("[MSG:Restoring defaults]\r\nok\r\n"));
    EXPECT_THAT(answer(second, "$N"), HasSubstr("$N0=\r\n$N1=\r\nok"));
}

TEST_F(Grbl, CutsArcsIntoChordsWithinItsTolerance) {
    (void)answer(grbl, "G2 X0 Y0 I10 F3000");
    run_until_rest(grbl);
    EXPECT_NEAR(grbl.truth().travelled, 20.0 * std::acos(-1.0), 0.01);
    (void)answer(grbl, "G3 X10 Y10 R10 F3000");
    run_until_rest(grbl);
    EXPECT_NEAR(grbl.truth().travelled, 25.0 * std::acos(-1.0), 0.02);
}

TEST_F(Grbl, MayReportIdleWhileAcknowledgedMotionIsStillWaiting) {
    (void)answer(grbl, "$10=3");
    grbl.receive("G1X10F600\nG1X20\n");
    EXPECT_EQ(grbl.take_output(), "ok\r\n");
    EXPECT_THAT(status(grbl), StartsWith("<Idle|MPos:0.000,0.000,0.000|Bf:14,"));
}

TEST_F(Grbl, NamesTheLineThatIsPlannedNext) {
    GrblEmulator numbered({.line_numbers = true});
    (void)numbered.take_output();
    (void)answer(numbered, "N7 G1 X50 F1200");
    EXPECT_THAT(status(numbered), HasSubstr("|Ln:7|"));
    EXPECT_THAT(answer(numbered, "$G"), HasSubstr("ok"));
}

} // namespace
} // namespace millwright::emulators
