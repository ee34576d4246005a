// A PMAC on the command line, against the emulated one as a program of its own.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::test {
namespace {

using testing::HasSubstr;

struct Pmac : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "port").string();
};

TEST_F(Pmac, AnswersCommands) {
    Emulator emulator(port, {}, "pmac");
    const Ended ended = run({"pmac", "TYPE", "P5=7*6", "P5", "--port", port});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, "PMAC1,ISA,BATTERY,PID,CLOCK X1\n42\n");
    const Ended refused = run({"pmac", "X100", "P5", "--port", port});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("'X100' is refused: ERR005, no buffer is open"));
    EXPECT_EQ(refused.out, "");
}

TEST_F(Pmac, WarnsOfWhatAFileTurnsOff) {
    write_content(scratch / "pmac.ini", "I100=1\nI125=$13C000\nI111=0\nI130=701\nNONSENSE\nI131=795");
    Emulator emulator(port, {}, "pmac");
    const Ended ended = run({"pmac", "I131", "--load", (scratch / "pmac.ini").string(), "--port", port});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err,
                HasSubstr("pmac.ini:2:1: I125 bit 17: motor 1: its limit switches are not looked at"));
    EXPECT_THAT(ended.err, HasSubstr("pmac.ini:3:1: I111=0"));
    EXPECT_THAT(ended.out, HasSubstr("'NONSENSE' is refused"));
    EXPECT_THAT(ended.out, HasSubstr("795\n"));
}

TEST_F(Pmac, IsToldFromSomethingElse) {
    Emulator emulator(port, {});
    const Ended ended = run({"pmac", "#1P", "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("nobody answers as a PMAC"));
    EXPECT_EQ(run({"pmac", "--port", port}).exit_code, 1);
}

TEST_F(Pmac, AMotionProgramIsLookedThroughBeforeAnybodyIsAsked) {
    const std::string file = (scratch / "moves.pmc").string();
    write_content(file, "LINEAR ; straight\nTM500\nX10 Y-5\nDRILL\n");
    const Ended ended = run({"send", file, "--driver", "pmac", "--port", (scratch / "none").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("moves.pmc:4"));
    EXPECT_THAT(ended.err, HasSubstr("'DRILL' is no line of a motion program"));
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
    EXPECT_THAT(ended.err, HasSubstr("no power"));
    EXPECT_THAT(run({"pmac", "#1P", "--port", port}).out, testing::ContainsRegex("^-?0(\\.[0-9])?\n"));
}

TEST_F(Pmac, FindsTheOffsetOfAMotorAndItsAnswerToAStep) {
    Emulator emulator(port, {"--arm"}, "pmac");
    ASSERT_EQ(run({"pmac", "I900=1", "--port", port}).exit_code, 0); // as its encoder is wired
    const Ended found =
        run({"arm", "offset", "1", "--port", port, "--from", "-980", "--most-way", "1e9", "--apply"});
    ASSERT_EQ(found.exit_code, 0) << found.err;
    // The amplifier of motor 1 adds 996 bits, as the thesis found; to the bit the core's tests find it, in
    // computed time.
    EXPECT_THAT(found.out, testing::ContainsRegex("-(9[89][0-9]|100[0-9]) is the middle \\(it was 0\\)"));
    EXPECT_THAT(run({"pmac", "I129", "--port", port}).out, testing::ContainsRegex("^-(9[89]|100)"));
    ASSERT_EQ(run({"pmac", "I100=1", "#1J/", "--port", port}).exit_code, 0);
    const std::string csv = (scratch / "step.csv").string(), png = (scratch / "step.png").string();
    const Ended step = run({"arm", "step", "1", "--port", port, "--out", csv, "--picture", png});
    ASSERT_EQ(step.exit_code, 0) << step.err;
    EXPECT_THAT(step.out, HasSubstr("to change:"));
    EXPECT_THAT(content_of(csv), testing::StartsWith("seconds,counts\n0.0"));
    EXPECT_TRUE(std::filesystem::exists(png));
}

} // namespace
} // namespace millwright::test
