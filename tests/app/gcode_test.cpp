#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string loops = "assets/samples/gcode/loops.ngc";

TEST(Gcode, CheckCountsLinesAndMoves) {
    const Ended ended = run({"gcode", "check", loops});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("moves, 0 errors"));
}

TEST(Gcode, CheckTellsEveryErrorWithItsPlace) {
    const ScratchFolder folder;
    const auto file = folder.path() / "bad.ngc";
    write_content(file, "G0 X1\nG1 X2\nG0 X1 X2\nM2\n");
    const Ended ended = run({"gcode", "check", file.string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("millwright: " + file.string() +
                          ":2:1: G1 has a feed rate of zero (set the feed rate with F)"));
    EXPECT_THAT(ended.err, HasSubstr(file.string() + ":3:7: a line may have only one X word"));
    EXPECT_EQ(ended.out, "4 lines, 1 move, 2 errors\n");
}

TEST(Gcode, CheckReadsOnBehindTheErrorsThatItLists) {
    const ScratchFolder folder;
    const auto file = folder.path() / "bad.ngc";
    std::string text;
    for (int n = 0; n < 250; ++n) {
        text += "G0 X1 X2\n";
    }
    write_content(file, text + "G0 X1\nM2\n");
    const Ended ended = run({"gcode", "check", file.string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(file.string() + ":100:"));
    EXPECT_THAT(ended.err, Not(HasSubstr(file.string() + ":101:")));
    EXPECT_THAT(ended.err, HasSubstr("bad.ngc: 150 more errors are not listed\n"));
    EXPECT_EQ(ended.out, "252 lines, 1 move, 250 errors\n");
    const auto answer = nlohmann::json::parse(run({"gcode", "check", file.string(), "--json"}).out);
    EXPECT_EQ(answer.at("lines"), 252);
    EXPECT_EQ(answer.at("errors").size(), 100U);
    EXPECT_EQ(answer.at("further_errors"), 150);
}

TEST(Gcode, CheckAnswersInJson) {
    const ScratchFolder folder;
    const auto file = folder.path() / "bad.ngc";
    write_content(file, "G0 X1\nG0 X1 Y[1/0]\nM2\n");
    const Ended ended = run({"gcode", "check", file.string(), "--json"});
    EXPECT_EQ(ended.exit_code, 1);
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_EQ(answer.at("lines"), 3);
    EXPECT_EQ(answer.at("moves"), 1);
    ASSERT_EQ(answer.at("errors").size(), 1U);
    EXPECT_EQ(answer.at("errors")[0].at("line"), 2);
    EXPECT_EQ(answer.at("errors")[0].at("column"), 11);
    EXPECT_EQ(answer.at("errors")[0].at("message"), "division by zero");
}

/// Byte order marks, the end of file of DOS and lines behind the program: what `check` passes the others
/// take.
TEST(Gcode, EveryCommandTakesWhatCheckPasses) {
    const ScratchFolder folder;
    const auto file = (folder.path() / "part.nc").string();
    const std::string mark = "\xEF\xBB\xBF";
    const std::string dos_end = "\x1A";
    for (const std::string& text : {mark + "; options\nG21 G90\nG0 Z5\nG0 X0 Y0\nG1 Z-1 F100\nM2\n",
                                    "G21 G90\nG0 X1 Y1 Z1\nG1 X2 F10\nM2\n" + dos_end,
                                    "%\nG21 G90\nG0 X1 Y1 Z1\nG1 X2 F10\nM30\n%\n" + dos_end}) {
        write_content(file, text);
        EXPECT_THAT(run({"gcode", "check", file}).out, HasSubstr(", 0 errors"));
        EXPECT_EQ(run({"gcode", "check", file, "--dialect", "grbl"}).exit_code, 0);
        EXPECT_EQ(run({"gcode", "canon", file}).exit_code, 0);
        EXPECT_EQ(run({"gcode", "time", file, "--machine", "router-xyz"}).exit_code, 0);
        const Ended converted = run({"gcode", "convert", file, "--machine", "router-xyz", "--post", "grbl"});
        EXPECT_EQ(converted.exit_code, 0) << converted.err;
        const Ended sent = run({"send",
                                file,
                                "--driver",
                                "virtual",
                                "--machine",
                                "router-xyz",
                                "--log",
                                folder.path().string()});
        EXPECT_EQ(sent.exit_code, 0) << sent.err;
    }
}

// Planning takes 0 for it, and said nothing.
TEST(Gcode, TimeSaysWhatIsNotKnown) {
    const ScratchFolder folder;
    const auto file = folder.path() / "part.ngc";
    write_content(file, "G21 G90\nG0 X1 Y1 Z5\nG53 G0 Z0\nM2\n");
    for (const char* command : {"time", "pulses"}) {
        const Ended ended = run({"gcode", command, file.string(), "--machine", "router-xyz"});
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.err, HasSubstr("part.ngc:3:1: G53 moves to a machine position"));
        const Ended placed =
            run({"gcode", command, file.string(), "--machine", "router-xyz", "--origin", "1,2,-50"});
        EXPECT_EQ(placed.exit_code, 0) << placed.err;
        EXPECT_EQ(placed.err, "");
    }
    const Ended json = run({"gcode", "time", file.string(), "--machine", "router-xyz", "--json"});
    EXPECT_THAT(json.out, HasSubstr("G53 moves to a machine position"));
    const Ended refused = run({"cordic", "run", file.string()});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("part.ngc:3:1: G53 moves to a machine position"));
    EXPECT_EQ(run({"cordic", "run", file.string(), "--origin", "1,2,-50"}).exit_code, 0);
}

TEST(Gcode, CheckReadsKlartextAndNamesOtherLanguages) {
    const ScratchFolder folder;
    const auto file = folder.path() / "part.h";
    write_content(file, "0 BEGIN PGM PART MM\n1 L X+1 R0 FMAX\n2 L Z-1 R0 F100\n3 M30\n4 END PGM PART MM\n");
    EXPECT_EQ(run({"gcode", "check", file}).out, "5 lines of Heidenhain Klartext, 2 moves, 0 errors\n");
    const Ended timed = run({"gcode", "time", file, "--machine", "router-xyz"});
    EXPECT_EQ(timed.exit_code, 1);
    EXPECT_THAT(timed.err, HasSubstr("part.h:1:1: this is Heidenhain Klartext, not G-code"));
    EXPECT_THAT(timed.err, HasSubstr("only 'millwright gcode check' can read it"));
    const Ended informed = run({"plot", "info", file});
    EXPECT_EQ(informed.exit_code, 1);
    EXPECT_THAT(informed.err, HasSubstr("this is Heidenhain Klartext, neither a plot nor G-code"));
    write_content(file, "0 BEGIN PGM PART MM\r\n1 CYCL DEF 200 DRILLING\r\n2 END PGM PART MM\r\n");
    const Ended foreign = run({"gcode", "check", file, "--json"});
    EXPECT_EQ(foreign.exit_code, 1);
    EXPECT_THAT(foreign.out, HasSubstr("Millwright reads only the Klartext blocks that its posts write"));
    write_content(file, "N10 R1=5\nN20 G1 X=R1 F100\nN30 M30\n");
    const Ended other = run({"gcode", "check", file});
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.err, HasSubstr("part.h:1:1: this is the Siemens Sinumerik language, not G-code"));
    EXPECT_THAT(other.out, HasSubstr(" 1 error"));
}

TEST(Gcode, TheDialectDecides) {
    EXPECT_EQ(run({"gcode", "check", loops, "--dialect", "linuxcnc"}).exit_code, 0);
    const Ended ended = run({"gcode", "check", loops, "--dialect", "grbl"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("Grbl does not support"));
}

// LinuxCNC reports an error at the end of such a file, Grbl reads lines as they come.
TEST(Gcode, AProgramWithoutAnEndIsReadWithANoticeWhereItsControlAcceptsIt) {
    const ScratchFolder folder;
    const std::string file = (folder.path() / "part.nc").string();
    write_content(file, "G21 G90 S1000 M3\nG0 X1 Y1 Z5\nG1 Z-1 F100\n");
    const std::string notice = "part.nc: the program does not end with M2 or M30; it was read to its last "
                               "line (Grbl does not switch "
                               "off the spindle and the coolant)\n";
    const std::vector<std::vector<std::string>> commands{
        {"gcode", "check", file},
        {"gcode", "time", file, "--machine", "router-xyz"},
        {"gcode", "pulses", file, "--machine", "router-xyz"},
        {"gcode", "convert", file, "--machine", "router-xyz", "--post", "linuxcnc-xyz"}};
    for (std::vector<std::string> words : commands) {
        const Ended refused = run(words);
        EXPECT_EQ(refused.exit_code, 1) << words[1];
        EXPECT_THAT(
            refused.err,
            HasSubstr("part.nc:3:1: the program has no end: M2, M30 or % is missing (LinuxCNC reports an "
                      "error there"))
            << words[1];
        words.insert(words.end(), {"--dialect", "grbl"});
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0) << words[1] << ended.err;
        EXPECT_THAT(ended.err, HasSubstr(notice)) << words[1];
        if (words[1] == "convert") {
            EXPECT_THAT(ended.out, HasSubstr("\nM2\n"));
        }
    }
    const Ended json = run({"gcode", "check", file, "--dialect", "grbl", "--json"});
    EXPECT_EQ(nlohmann::json::parse(json.out).at("warnings").size(), 1U);
    write_content(file, "G0 X1\nM30\n");
    EXPECT_EQ(run({"gcode", "check", file, "--dialect", "grbl"}).err, "");
}

TEST(Gcode, ConvertKeepsASpindleSpeedThatChangesWithoutM3) {
    const ScratchFolder folder;
    const std::string file = (folder.path() / "part.ngc").string();
    write_content(file, "G21 G90 S1500 M3\nG0 X1 Y1 Z5\nG1 Z-1 F100\nX20\nS800\nX30\nM2\n");
    const Ended ended = run({"gcode", "convert", file, "--machine", "router-xyz", "--post", "grbl"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("X20.000\nS800 M3\nX30.000\n"));
}

TEST(Gcode, CanonPrintsInRs274sWords) {
    const Ended ended = run({"gcode", "canon", "assets/samples/gcode/straight-lines.ngc"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.out, HasSubstr("    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n"));
    EXPECT_THAT(ended.out,
                HasSubstr("N10    STRAIGHT_FEED(1.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)\n"));
}

TEST(Gcode, CanonPrintsUpToTheFirstError) {
    const ScratchFolder folder;
    const auto file = folder.path() / "bad.ngc";
    write_content(file, "G0 X1\nG1 X2\nG0 X3\nM2\n");
    const Ended ended = run({"gcode", "canon", file.string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("STRAIGHT_TRAVERSE(1.0000"));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("(3.0000")));
    EXPECT_THAT(ended.err, HasSubstr(file.string() + ":2:1: "));
}

TEST(Gcode, WithoutATableEveryToolIsTakenForGranted) {
    const ScratchFolder folder;
    const auto file = folder.path() / "tools.ngc";
    write_content(file, "T7 M6\nG43 H7\nG0 Z1\nM2\n");
    EXPECT_EQ(run({"gcode", "check", file.string()}).exit_code, 0);
    const Ended ended = run({"gcode", "check", file.string(), "--tools", "assets/samples/gcode/tools.tbl"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(":1:1: tool 7 is not in the tool table"));
}

TEST(Gcode, CanonKnowsTheToolsOfRs274) {
    const ScratchFolder folder;
    const auto file = folder.path() / "tools.ngc";
    write_content(file, "T3 M6\nG43\nM2\n");
    EXPECT_THAT(run({"gcode", "canon", file.string()}).out,
                HasSubstr("USE_TOOL_LENGTH_OFFSET(0.0000 0.0000 32.3342, "));
}

TEST(Gcode, TimeIsThatOfThePlannedMotion) {
    const ScratchFolder folder;
    const auto file = folder.path() / "there.ngc";
    write_content(file, "G21 G90\nG1 X100 F3000\nM2\n");
    const Ended ended = run({"gcode", "time", file.string(), "--machine", "router-xyz", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_NEAR(answer.at("time_s").get<double>(), 100.0 / 50.0 + 50.0 / 800.0, 1e-9);
    EXPECT_NEAR(answer.at("length_mm").get<double>(), 100.0, 1e-9);
    EXPECT_EQ(answer.at("blocks").get<int>(), 2); // the feed and the end
}

TEST(Gcode, TimeWarnsOfWaysBeyondTheTravel) {
    const ScratchFolder folder;
    const auto file = folder.path() / "far.ngc";
    write_content(file, "G21 G90\nG1 X1 Y0 Z0 F3000\nG1 Y1 X5000\nX6000\nM2\n");
    const Ended ended = run({"gcode", "time", file.string(), "--machine", "router-xyz", "--json"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err, HasSubstr("far.ngc:3:7: axis X would move to 5000.000, outside "));
    const auto warnings = nlohmann::json::parse(ended.out).at("warnings");
    ASSERT_EQ(warnings.size(), 1U);
    EXPECT_EQ(warnings[0].at("line"), 3);
    EXPECT_EQ(warnings[0].at("column"), 7);
}

TEST(Gcode, TimeDependsOnHowCornersAreTaken) {
    const ScratchFolder folder;
    const auto file = folder.path() / "corner.ngc";
    write_content(file, "G21 G90\nG1 X50 F3000\nY50\nX0\nY0\nM2\n");
    const auto time = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"gcode", "time", file.string(), "--machine", "router-xyz", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        return ended.exit_code == 0 ? nlohmann::json::parse(ended.out).at("time_s").get<double>() : -1.0;
    };
    const double rest = time({"--look-ahead", "1"});
    const double exact = time({});
    const double rounded = time({"--path-tolerance", "1"});
    EXPECT_NEAR(rest, 4.0 * (50.0 / 50.0 + 50.0 / 800.0), 1e-9);
    EXPECT_LT(exact, rest);
    EXPECT_LT(rounded, exact);
    EXPECT_GT(time({"--junction-deviation", "0.01"}), 200.0 / 50.0);
    EXPECT_EQ(time({"--path-tolerance", "-1"}), -1.0);
}

TEST(Gcode, TimeNeedsAMachineWithTheAxes) {
    const ScratchFolder folder;
    const auto file = folder.path() / "turn.ngc";
    write_content(file, "G21\nG0 C90\nM2\n");
    const Ended turning = run({"gcode", "time", file.string(), "--machine", "router-xyz"});
    EXPECT_EQ(turning.exit_code, 1);
    EXPECT_THAT(turning.err, HasSubstr("turn.ngc:2:4: the machine 'XYZ router' has no axis C"));
    EXPECT_EQ(run({"gcode", "time", file.string(), "--machine", "ac-table"}).exit_code, 0);
    const Ended unknown = run({"gcode", "time", file.string(), "--machine", "lathe"});
    EXPECT_EQ(unknown.exit_code, 1);
    EXPECT_THAT(unknown.err, HasSubstr("unknown machine 'lathe' (known: ac-table"));
    EXPECT_EQ(run({"gcode", "time", file.string()}).exit_code, 2);
}

/// A timer's tick is missed by up to its half, anywhere in it with the same likelihood: 1 / sqrt(12) of it.
TEST(Gcode, PulsesAreAsManyAsTheStepsAndAsUnevenAsTheTimer) {
    const ScratchFolder folder;
    const auto file = folder.path() / "there.ngc";
    write_content(file, "G21 G90\nG1 X100 Y-20.5 F3000\nX90 F1500\nC10 F1000\nM2\n");
    const Ended ended = run({"gcode",
                             "pulses",
                             file.string(),
                             "--machine",
                             "ac-table",
                             "--steps",
                             "Y=80",
                             "--timer",
                             "1e5",
                             "--min-interval",
                             "1",
                             "--jitter-limit",
                             "4",
                             "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    const auto& axes = answer.at("axes");
    ASSERT_EQ(axes.size(), 5U); // X Y Z A C
    const auto& x = axes[0];
    EXPECT_EQ(x.at("pulses"), 250 * (100 + 10));
    EXPECT_EQ(x.at("reversals"), 1);
    const double planned = 250.0 * 50.0 * 100.0 / std::hypot(100.0, 20.5);
    EXPECT_NEAR(x.at("planned_hz").get<double>(), planned, 1e-3 * planned);
    EXPECT_LE(x.at("max_jitter_s").get<double>(), 0.5e-5 * (1.0 + 1e-9));
    EXPECT_NEAR(x.at("rms_jitter_s").get<double>(), 1e-5 / std::sqrt(12.0), 0.03e-5);
    EXPECT_NEAR(x.at("over_limit").get<double>(), 0.2 * 250 * 110, 0.02 * 250 * 110);
    EXPECT_EQ(axes[1].at("pulses"), 1640);
    EXPECT_EQ(axes[2].at("pulses"), 0);
    EXPECT_EQ(axes[4].at("pulses"), 1000);
    EXPECT_EQ(axes[4].at("steps_per_deg"), 100.0);
    const Ended timed = run({"gcode", "time", file.string(), "--machine", "ac-table", "--json"});
    EXPECT_NEAR(
        answer.at("time_s").get<double>(), nlohmann::json::parse(timed.out).at("time_s").get<double>(), 1e-9);
}

TEST(Gcode, PulsesSayWhereTheTimerDoesNotKeepUp) {
    const ScratchFolder folder;
    const auto file = folder.path() / "fast.ngc";
    write_content(file, "G21 G90\nG1 X1 F60\nX100 F3000\nM2\n");
    const auto pulses = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"gcode", "pulses", file.string(), "--machine", "router-xyz"};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    const Ended kept = pulses({});
    EXPECT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_THAT(kept.out, HasSubstr("250/mm        25000"));
    const Ended slow = pulses({"--timer", "10000"});
    EXPECT_EQ(slow.exit_code, 1);
    EXPECT_THAT(slow.err,
                HasSubstr("fast.ngc:3: from here on the timer cannot keep up with X: 12500 pulses per second "
                          "are needed, 5000 are possible"));
    for (const char* steps : {"A=100", "X=0", "X=", "X", "XY=1", "X=1e9", "X=nan", "X=5mm"}) {
        const Ended ended = pulses({"--steps", steps});
        EXPECT_EQ(ended.exit_code, 1) << steps;
        EXPECT_THAT(ended.err,
                    HasSubstr(std::string("--steps ") + steps +
                              " does not name an axis of the machine and its steps"));
    }
}

TEST(Gcode, WhatIsMissingOrWrongIsNamed) {
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"gcode"},
                                               {"gcode", "check"},
                                               {"gcode", "run", loops},
                                               {"gcode", "check", loops, "--dialect", "fanuc"},
                                               {"gcode", "canon", loops, "--json"}}) {
        EXPECT_EQ(run(arguments).exit_code, 2) << testing::PrintToString(arguments);
    }
    const Ended ended = run({"gcode", "check", "no/such/file.ngc"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("no/such/file.ngc: cannot be read: No such file or directory"));
}

} // namespace
} // namespace millwright::test
