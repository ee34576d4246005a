// A PMAC on the command line, against the emulated one as a program of its own.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace millwright::test {
namespace {

using testing::HasSubstr;

/// The guard in the card takes the power then, as it should, and what was asked for is not done.
constexpr const char* computer_was_busy = "the card received nothing from this computer for 50 ms";

struct Pmac : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "port").string();

    /// Sends a program that moves the fifth axis to a card with these settings, with `more` beside --power.
    [[nodiscard]] Ended roll(const std::string& settings, const std::vector<std::string>& more) const {
        const std::string file = (scratch / "roll.pmc").string();
        const std::string ini = (scratch / "arm.ini").string();
        const std::string logs = (scratch / "logs").string();
        write_content(file, "ABS LINEAR TM500\nX1 B-30\n");
        write_content(ini, settings);
        EXPECT_EQ(run({"pmac", "--load", ini, "TYPE", "--port", port}).exit_code, 0);
        std::vector<std::string> words{
            "send", file, "--driver", "pmac", "--axes", "XYZAB", "--port", port, "--power", "--log", logs};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
};

TEST_F(Pmac, AnswersCommands) {
    Emulator emulator(port, {}, "pmac");
    const Ended ended = run({"pmac", "TYPE", "P5=7*6", "P5", "--port", port});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, "PMAC1,ISA,BATTERY,PID,CLOCK X1\n42\n");
    const Ended refused = run({"pmac", "X100", "P5", "--port", port});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("'X100' is rejected: ERR005, no buffer is open"));
    EXPECT_EQ(refused.out, "");
    const Ended powered = run({"pmac", "#1J/", "--port", port});
    EXPECT_EQ(powered.exit_code, 1);
    EXPECT_THAT(powered.err, HasSubstr("would enable joint 1"));
    EXPECT_THAT(powered.err, HasSubstr("--power"));
    const Ended stopped = run({"pmac", "A", "--port", port});
    EXPECT_EQ(stopped.exit_code, 0) << stopped.err;
    EXPECT_THAT(stopped.out, HasSubstr("nothing moves"));
    EXPECT_THAT(run({"pmac", "I130=99999999", "--port", port}).err, HasSubstr("at most 24 bits"));
    EXPECT_THAT(run({"pmac", "I111=0", "--port", port}).err,
                HasSubstr("a following error does not stop motor 1"));
    const Ended reset = run({"pmac", "$$$", "--port", port});
    EXPECT_THAT(reset.err, HasSubstr("the card was reset"));
    EXPECT_EQ(reset.err.find("the card was reset"), reset.err.rfind("the card was reset"));
    EXPECT_EQ(reset.out, "");
}

TEST_F(Pmac, FillsABufferWithSeparateArguments) {
    Emulator emulator(port, {}, "pmac");
    const Ended filled =
        run({"pmac", "OPEN PLC 5", "CLEAR", "P20=7", "CLOSE", "LIST PLC 5", "5", "P0", "--port", port});
    EXPECT_EQ(filled.exit_code, 0) << filled.err;
    EXPECT_THAT(filled.out, testing::StartsWith("P20=7\n"));
    EXPECT_THAT(filled.out, testing::EndsWith("\n5\n"));
    const Ended open = run({"pmac", "OPEN PLC 5", "CLEAR", "--port", port});
    EXPECT_EQ(open.exit_code, 1);
    EXPECT_THAT(open.err, HasSubstr("'OPEN PLC 5' has no CLOSE: none of it was sent"));
    EXPECT_THAT(run({"pmac", "LIST PLC 5", "--port", port}).out, testing::StartsWith("P20=7\n"));
}

TEST_F(Pmac, WarnsOfWhatAFileTurnsOff) {
    write_content(scratch / "pmac.ini", "I100=1\nI125=$13C000\nI111=0\nI130=701\nNONSENSE\nI131=795");
    Emulator emulator(port, {}, "pmac");
    const Ended ended = run({"pmac", "I131", "--load", (scratch / "pmac.ini").string(), "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("pmac.ini:2:1: I125 bit 17: motor 1: its limit switches are ignored"));
    EXPECT_THAT(ended.err, HasSubstr("pmac.ini:3:1: I111=0"));
    EXPECT_THAT(ended.err, HasSubstr("pmac.ini:5:1: NONSENSE is skipped"));
    EXPECT_EQ(ended.out, ""); // nothing more was sent
    EXPECT_EQ(run({"pmac", "I131", "--port", port}).out, "795\n");
    write_content(scratch / "pmac.ini", "I131=many\nI130=702");
    const Ended refused = run({"pmac", "--load", (scratch / "pmac.ini").string(), "--port", port});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("pmac.ini:1: 'I131=many' is rejected"));
    EXPECT_EQ(run({"pmac", "I130", "--port", port}).out, "702\n"); // the others are sent
}

// Without the offsets and decoding of the arm's drives the first motor ran away.
TEST_F(Pmac, TheDrivesOfTheArmHaveSettingsOfTheirOwn) {
    Emulator emulator(port, {"--arm", "--wait-for-host", "0.01"}, "pmac");
    const Ended moved = run({"pmac",
                             "--load",
                             "assets/samples/pmac-l3.ini",
                             "#1J:120",
                             "#2J:-222",
                             "#3J:150",
                             "#4J:-150",
                             "#1P",
                             "#2P",
                             "#3P",
                             "#4P",
                             "--power",
                             "--port",
                             port});
    EXPECT_EQ(moved.exit_code, 0) << moved.err;
    EXPECT_THAT(moved.err, testing::Not(HasSubstr("protection off")));
    std::istringstream positions(moved.out);
    for (const double wanted : {120.0, -222.0, 150.0, -150.0}) {
        double position = 0.0;
        positions >> position;
        EXPECT_NEAR(position, wanted, 1.0);
    }
}

TEST_F(Pmac, WaitsForWhatACommandSetsGoingAndTakesNoEndlessJog) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    ASSERT_EQ(
        run({"pmac", "--load", "assets/samples/pmac-arm.ini", "#1J/", "--power", "--port", port}).exit_code,
        0);
    const Ended went = run({"pmac", "#1J:600", "#1P", "--power", "--port", port});
    EXPECT_EQ(went.exit_code, 0) << went.err;
    EXPECT_THAT(went.out, testing::ContainsRegex("^(599|600)"));
    const Ended endless = run({"pmac", "#1J+", "--port", port});
    EXPECT_EQ(endless.exit_code, 1);
    EXPECT_THAT(endless.err, HasSubstr("would jog without an end"));
    Program far({"pmac", "#1J:2000000", "--power", "--port", port});
    far.wait_for_error_text("Ctrl+C stops them");
    far.send(SIGINT);
    EXPECT_NE(far.end().exit_code, 0);
    const std::string stopped = run({"pmac", "#1P", "--port", port}).out;
    EXPECT_LT(std::stod(stopped), 1'000'000.0);
    EXPECT_EQ(run({"pmac", "#1P", "--port", port}).out, stopped);
}

// F2: motors are not monitored once the program has ended.
TEST_F(Pmac, MotorsKeepNoPowerThatNobodyAskedToKeep) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    const auto has_power = [&] { // loop closed, amplifier enabled: bit 14 of the second word
        const std::string words = run({"pmac", "#1?", "--port", port}).out;
        return words.size() > 8 && (std::stoi(words.substr(6, 6), nullptr, 16) >> 14 & 1) == 1;
    };
    const Ended went = run({"pmac", "I100=1", "#1J:200", "--power", "--port", port});
    EXPECT_EQ(went.exit_code, 0) << went.err;
    EXPECT_THAT(went.err, HasSubstr("The motors are disabled; --keep-power"));
    EXPECT_FALSE(has_power());
    const Ended kept = run({"pmac", "#1J/", "--power", "--keep-power", "--port", port});
    EXPECT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_THAT(kept.err, HasSubstr("The motors are enabled and no longer supervised."));
    EXPECT_TRUE(has_power());
    EXPECT_TRUE(has_power()); // questions leave it as it was
    const Ended jogged = run({"pmac", "#1J:200", "--port", port});
    EXPECT_EQ(jogged.exit_code, 0) << jogged.err;
    EXPECT_TRUE(has_power()); // so does motion with the power that was there
    EXPECT_EQ(run({"pmac", "#1K", "--port", port}).exit_code, 0);
    EXPECT_FALSE(has_power());
}

// The lines behind the refused OPEN went into the buffer that it had opened.
TEST_F(Pmac, AFileWhoseBufferIsRefusedSetsWhatStandsBehindIt) {
    Emulator emulator(port, {}, "pmac");
    const std::string ini = (scratch / "demo.ini").string();
    write_content(ini, "OPEN PLC 5 WHILE (1\nCLEAR\nP1=2\nCLOSE\nI130=3000\nI131=900\n");
    const Ended ended = run({"pmac", "--load", ini, "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("demo.ini:1: 'OPEN PLC 5 WHILE (1' is rejected"));
    EXPECT_THAT(ended.err, HasSubstr("demo.ini:3: 'P1=2' is not executed"));
    const Ended set = run({"pmac", "I130", "I131", "P1", "LIST PLC 5", "--port", port});
    EXPECT_EQ(set.out, "3000\n900\n0\n");
}

// F2: a PLC program moved a motor without --power, and again behind "The motors are disabled".
TEST_F(Pmac, APlcProgramNeedsPowerThatAPersonGaveAndEndsWithTheCommand) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    const auto text_of = [&](const std::string& question) {
        return run({"pmac", question, "--port", port}).out;
    };
    ASSERT_EQ(run({"pmac", "--load", "assets/samples/pmac-arm.ini", "I122=1", "--port", port}).exit_code, 0);
    ASSERT_EQ(run({"pmac", "OPEN PLC 6 CLEAR CMD\"#1J+\" CLOSE", "--port", port}).exit_code, 0);
    const Ended refused = run({"pmac", "ENABLE PLC 6", "--port", port});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err,
                HasSubstr("'ENABLE PLC 6' runs a program of the card, which could enable motors"));
    EXPECT_THAT(refused.err, HasSubstr("--power"));
    EXPECT_THAT(text_of("#1P"), testing::ContainsRegex("^-?0(\\.[0-9])?\n"));
    write_content(scratch / "plc.ini", "P5=1\nENABLE PLC 6\n");
    const Ended file = run({"pmac", "--load", (scratch / "plc.ini").string(), "--port", port});
    EXPECT_EQ(file.exit_code, 1);
    EXPECT_THAT(file.err, HasSubstr("--power"));
    Program moving({"pmac", "ENABLE PLC 6", "--power", "--port", port});
    moving.wait_for_error_text("Ctrl+C stops them");
    moving.send(SIGINT);
    EXPECT_THAT(moving.end().err, HasSubstr("The motors are disabled"));
    const std::string stopped = text_of("#1P");
    EXPECT_GT(std::stod(stopped), 10.0);
    EXPECT_EQ(text_of("#1P"), stopped);
}

// They were refused as commands to moving motors.
TEST_F(Pmac, StopsAndQuestionsPassWhileSomethingElseMovesTheMotors) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    ASSERT_EQ(run({"pmac",
                   "--load",
                   "assets/samples/pmac-arm.ini",
                   "#1J/",
                   "I122=0.05",
                   "--power",
                   "--keep-power",
                   "--port",
                   port})
                  .exit_code,
              0);
    for (const std::string stop : {"A", "#1J/", "#1K"}) {
        std::ofstream(port) << "#1J/\r#1J+\r" << std::flush;
        EXPECT_THAT(run({"pmac", "#1P", "--port", port}).err, testing::Not(HasSubstr("not possible")))
            << stop;
        const Ended ended = run({"pmac", stop, "--port", port});
        EXPECT_EQ(ended.exit_code, 0) << stop << ended.err;
        const std::string at = run({"pmac", "#1P", "--port", port}).out;
        EXPECT_GT(std::stod(at), 1.0) << stop;
        EXPECT_NEAR(std::stod(run({"pmac", "#1P", "--port", port}).out), std::stod(at), 1.0) << stop;
    }
}

// F1.
TEST_F(Pmac, TellsWhichProtectionsTheCardHasOff) {
    Emulator emulator(port, {}, "pmac");
    const Ended fresh = run({"pmac", "TYPE", "--port", port});
    EXPECT_THAT(fresh.err,
                HasSubstr("protection off: motor 1 has no upper position limit in the card (I113"));
    const Ended set_up = run({"pmac", "--load", "assets/samples/pmac-arm.ini", "--port", port});
    EXPECT_EQ(set_up.exit_code, 0);
    EXPECT_EQ(set_up.err, "");
    EXPECT_EQ(run({"pmac", "TYPE", "--port", port}).err, "");
    (void)run({"pmac", "I111=0", "I225=$13C004", "--port", port});
    const Ended off = run({"pmac", "TYPE", "--port", port});
    EXPECT_THAT(off.err,
                HasSubstr("motor 1 has no following-error limit and is not stopped by it (I111 = 0)"));
    EXPECT_THAT(off.err, HasSubstr("motor 2 continues if its amplifier reports a fault (I225 bit 20)"));
    EXPECT_EQ(run({"pmac", "--load", "assets/samples/pmac-arm.ini", "--port", port}).err, "");
}

TEST_F(Pmac, NeedsNoPortThatTheEnvironmentNames) {
    Emulator emulator(port, {}, "pmac");
    ASSERT_EQ(setenv("MILLWRIGHT_PMAC_PORT", port.c_str(), 1), 0);
    EXPECT_THAT(run({"pmac", "TYPE"}).out, HasSubstr("PMAC1"));
    ASSERT_EQ(setenv("MILLWRIGHT_PMAC_PORT", (scratch / "none").c_str(), 1), 0);
    EXPECT_EQ(run({"pmac", "TYPE"}).exit_code, 1);
    ASSERT_EQ(unsetenv("MILLWRIGHT_PMAC_PORT"), 0);
    if (const Ended nobody = run({"pmac", "TYPE"}); nobody.exit_code != 0) { // else somebody runs one
        EXPECT_THAT(nobody.err, HasSubstr("MILLWRIGHT_PMAC_PORT"));
    }
}

TEST_F(Pmac, IsToldFromSomethingElse) {
    Emulator emulator(port, {});
    const Ended ended = run({"pmac", "#1P", "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the device that answers is not a PMAC"));
    EXPECT_EQ(run({"pmac", "--port", port}).exit_code, 1);
}

TEST_F(Pmac, AMotionProgramIsLookedThroughBeforeAnybodyIsAsked) {
    const std::string file = (scratch / "moves.pmc").string();
    write_content(file, "LINEAR ; straight\nTM500\nX10 Y-5\nDRILL\n");
    const Ended ended = run({"send", file, "--driver", "pmac", "--port", (scratch / "none").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("moves.pmc:4"));
    EXPECT_THAT(ended.err, HasSubstr("'DRILL' is not a line of a motion program"));
    const Ended later =
        run({"send", file, "--from-line", "2", "--driver", "pmac", "--port", (scratch / "none").string()});
    EXPECT_EQ(later.exit_code, 1);
}

TEST_F(Pmac, AMotionProgramNeedsPowerThatAPersonGave) {
    const std::string file = (scratch / "moves.pmc").string();
    write_content(file, "LINEAR\nTM500\nX10\n");
    Emulator emulator(port, {}, "pmac");
    const Ended ended =
        run({"send", file, "--driver", "pmac", "--port", port, "--log", (scratch / "logs").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the motors are not enabled"));
    EXPECT_THAT(run({"pmac", "#1P", "--port", port}).out, testing::ContainsRegex("^-?0(\\.[0-9])?\n"));
}

/// The axes of the arm, their home flags near, quick enough for a test.
const std::string arm_ini = "I100=1\nI200=1\nI300=1\nI400=1\nI902=10\nI907=10\nI912=10\nI917=10\n"
                            "I123=20\nI223=20\nI323=20\nI423=20\n#1->120X\n#2->222Y\n#3->150Z\n#4->150A\n";

// However long the computer is busy with other things: the emulated card's time then waits for the host.
TEST_F(Pmac, AMotionProgramRunsFromPowerOverHomeToItsLastLine) {
    const std::string file = (scratch / "moves.pmc").string(), logs = (scratch / "logs").string();
    write_content(file, "ABS LINEAR ; to and fro\nTA20\nTM400\nX10 Y-5\nX4 Y2 Z3 A-6\nX0Y0Z0A0\nX2.5\n");
    write_content(scratch / "arm.ini", arm_ini);
    Emulator emulator(port, {"--tcp", "0", "--wait-for-host", "0.01"}, "pmac");
    ASSERT_EQ(run({"pmac", "--load", (scratch / "arm.ini").string(), "I223", "--port", port}).exit_code, 0);
    const Ended ended =
        run({"send", file, "--driver", "pmac", "--port", port, "--power", "--home", "--log", logs});
    EXPECT_EQ(ended.exit_code, 0) << ended.err << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("Connected to a PMAC"));
    EXPECT_THAT(run({"pmac", "#1P", "--port", port}).out, testing::ContainsRegex("^(299|300)(\\.[0-9])?\n"));
    const std::string log = content_of(std::filesystem::path(logs) / "moves-0001.jsonl");
    const std::size_t last = log.rfind('\n', log.size() - 2) + 1;
    EXPECT_THAT(log.substr(0, log.find('\n')), HasSubstr(R"("blocks":7)"));
    EXPECT_THAT(log.substr(last), HasSubstr(R"("end":"done")")) << log;
    EXPECT_THAT(log.substr(last), HasSubstr(R"("executed_blocks":7)")) << log;
}

// The fifth one is simulated in the card, as docs/reference/pmac.md says.
TEST_F(Pmac, P12SendsAFifthAxis) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    const Ended ended = roll(arm_ini + content_of("assets/samples/pmac-axis-5.ini"), {"--home"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err << ended.out;
    EXPECT_THAT(run({"pmac", "#5P", "--port", port}).out,
                testing::ContainsRegex("^-213[34]")); // 30 of 25,600 / 360
}

TEST_F(Pmac, SaysThatACardHasNoMotorForAFifthAxis) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    const Ended ended = roll(arm_ini, {});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("if a motor is not active (Ix00 = 0): load the card's settings"));
}

// F4.
TEST_F(Pmac, ChecksThatJogsAndProgramsGoTheSameWay) {
    Emulator emulator(port, {"--wait-for-host", "0.01"}, "pmac");
    write_content(scratch / "arm.ini", arm_ini + "#2->-222Y\n");
    ASSERT_EQ(run({"pmac", "--load", (scratch / "arm.ini").string(), "TYPE", "--port", port}).exit_code, 0);
    const Ended still = run({"arm", "direction", "1", "--port", port});
    EXPECT_EQ(still.exit_code, 1);
    EXPECT_THAT(still.err, HasSubstr("motor 1 is disabled"));
    const Ended same = run({"arm", "direction", "1", "--power", "--port", port});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_THAT(
        same.out,
        testing::ContainsRegex("X1 gave \\+(119|12[01]) counts in a jog, \\+(119|12[01]) in a program"));
    const Ended other = run({"arm", "direction", "2", "--power", "--port", port});
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.out, HasSubstr("NOT the same direction"));
    EXPECT_THAT(other.out, HasSubstr("defined by -222 counts"));
}

// OPEN behind the stop was dropped, and the lines of its buffer were executed.
TEST_F(Pmac, AnOpenBehindAStopStillOpensItsBuffer) {
    Emulator emulator(port, {"--arm"}, "pmac");
    const Ended set = run({"pmac", "P5=0", "A OPEN PROG 1 CLEAR", "P5=3", "CLOSE", "P5", "--port", port});
    EXPECT_EQ(set.exit_code, 0) << set.err;
    EXPECT_THAT(set.out, testing::EndsWith("\n0\n"));
    EXPECT_THAT(run({"pmac", "LIST PROG 1", "--port", port}).out, HasSubstr("P5=3"));
}

TEST_F(Pmac, FindsTheOffsetOfAMotorAndItsAnswerToAStep) {
    Emulator emulator(port, {"--arm"}, "pmac");
    ASSERT_EQ(run({"pmac", "I900=1", "--port", port}).exit_code, 0); // as its encoder is wired
    Ended found;
    for (int n = 0; n < 5 && (n == 0 || found.err.find(computer_was_busy) != std::string::npos); ++n) {
        found = run({"arm", "offset", "1", "--port", port, "--from", "-980", "--most-way", "1e9", "--apply"});
    }
    ASSERT_EQ(found.exit_code, 0) << found.err;
    // The amplifier of motor 1 adds 996 bits, as the thesis found; to the bit the core's tests find it, in
    // computed time.
    EXPECT_THAT(found.out, testing::ContainsRegex("the middle is -(9[89][0-9]|100[0-9]) \\(it was 0\\)"));
    EXPECT_THAT(run({"pmac", "I129", "--port", port}).out, testing::ContainsRegex("^-(9[89]|100)"));
    const std::string csv = (scratch / "step.csv").string(), png = (scratch / "step.png").string();
    Ended step;
    for (int n = 0; n < 5 && (n == 0 || step.exit_code != 0); ++n) { // the power may be gone when it begins
        ASSERT_EQ(run({"pmac", "I100=1", "#1J/", "--power", "--keep-power", "--port", port}).exit_code, 0);
        step = run({"arm", "step", "1", "--port", port, "--out", csv, "--picture", png});
    }
    ASSERT_EQ(step.exit_code, 0) << step.err;
    EXPECT_THAT(step.out, HasSubstr("to change:"));
    EXPECT_THAT(content_of(csv), testing::StartsWith("seconds,counts\n0.0"));
    EXPECT_TRUE(std::filesystem::exists(png));
}

} // namespace
} // namespace millwright::test
