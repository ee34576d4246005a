// Programs for other controls, by the real program.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::ContainsRegex;
using testing::HasSubstr;
using testing::StartsWith;

struct Posts : testing::Test {
    ScratchFolder scratch;
    std::string part = (scratch / "part.ngc").string();
    std::string out = (scratch / "out").string();

    [[nodiscard]] Ended
    convert(const std::string& machine, const std::string& post, std::vector<std::string> more = {}) const {
        std::vector<std::string> words{"gcode", "convert", part, "--machine", machine, "--post", post};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }
};

TEST_F(Posts, ConvertWritesAProgramForAnotherControl) {
    write_content(part, "G21 G90 G94\nS8000 M3\nG0 Z50\nG0 X10 Y0 A5 C30\nG1 Z0 F600\nG1 X12 A7\nM2\n");
    const Ended klartext = convert("ac-table", "heidenhain");
    EXPECT_EQ(klartext.exit_code, 0) << klartext.err;
    EXPECT_THAT(klartext.out, StartsWith("0 BEGIN PGM PART MM\n"));
    EXPECT_THAT(klartext.out, HasSubstr("FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS\n"));
    EXPECT_THAT(klartext.err, HasSubstr("mm from the path of linear axis moves"));
    // The rapids before all axes are named go by the retract, and the first one of the tip in one piece.
    EXPECT_THAT(klartext.out, testing::Not(HasSubstr("Z+50.0000 R0 FMAX\n")));
    const Ended file = convert("ac-table", "fanuc-tcp", {"--out", out});
    EXPECT_EQ(file.exit_code, 0) << file.err;
    EXPECT_THAT(content_of(out), StartsWith("%\nO1000 (PART)\n"));
}

/// A tilt by 40 degrees 60 mm beside the axis: 60 mm (1 - cos 20 degrees) is 3.6 mm.
TEST_F(Posts, ConvertSaysWhatTheControlHasToHave) {
    const std::string file = (scratch / "length.ngc").string();
    write_content(file, "G21 G90 G54\nT1 M6\nG43 H1\nG0 X1 Y1 Z5\nG1 Z-1 F100\nG49\nM2\n");
    const Ended plain = run({"gcode", "convert", file, "--machine", "router-xyz", "--post", "linuxcnc-xyz"});
    EXPECT_EQ(plain.exit_code, 0);
    EXPECT_THAT(plain.err, HasSubstr("length.ngc:3:5: the tool length is unknown"));
    const Ended placed = run(
        {"gcode", "convert", file, "--machine", "router-xyz", "--post", "grbl", "--origin", "100,100,-50"});
    EXPECT_THAT(placed.err, HasSubstr("with a work offset (G54) of zero"));
    EXPECT_THAT(
        placed.out,
        ContainsRegex("^\\(all positions are machine positions: run with a work offset of zero\\)\n"));
    EXPECT_THAT(plain.out, testing::Not(HasSubstr("machine positions")));
    write_content(file, "G21 G90\nS1500\nG0 X1 Y1 Z5\nG1 Z-1 F100\nM2\n");
    const Ended still = run({"gcode", "convert", file, "--machine", "router-xyz", "--post", "linuxcnc-xyz"});
    EXPECT_THAT(still.err, HasSubstr("sets a spindle speed, 1500 1/min, but never starts the spindle"));
}

TEST_F(Posts, ConvertCutsFeedsUntilTheTipStaysOnTheProgramsWay) {
    write_content(part, "G21 G90 G94\nG0 X0 Y60 Z50\nG0 A0 C0\nG1 Z0 F600\nG1 X30 A40\nM2\n");
    const auto lines = [](const std::string& text) { return std::count(text.begin(), text.end(), '\n'); };
    const Ended whole = convert("ac-table", "fanuc-tcp", {"--tip-tolerance", "0"});
    const Ended near = convert("ac-table", "fanuc-tcp");
    ASSERT_EQ(near.exit_code, 0) << near.err;
    EXPECT_GT(lines(near.out), lines(whole.out) + 3);
    const auto most = [](const std::string& err) { return std::stod(err.substr(err.find("at most ") + 8)); };
    EXPECT_GT(most(whole.err), 0.5);
    EXPECT_LE(most(near.err), 0.012);
}

TEST_F(Posts, ConvertWritesRotaryAxesForGrblsThatHaveThem) {
    write_content(part, "G21 G90 G94\nS8000 M3\nG0 Z50\nG0 X10 A5 C30\nG1 Z0 F600\nG1 X12 A7\nM2\n");
    const Ended written = convert("ac-table", "grbl-rotary", {"--out", out});
    EXPECT_EQ(written.exit_code, 0) << written.err;
    EXPECT_THAT(content_of(out), HasSubstr("G93 G1"));
    EXPECT_EQ(run({"gcode", "check", out, "--dialect", "grbl", "--axes", "XYZAC"}).exit_code, 0);
    const Ended three = run({"gcode", "check", out, "--dialect", "grbl"});
    EXPECT_EQ(three.exit_code, 1);
    EXPECT_THAT(three.err, HasSubstr("this Grbl has the axes XYZ and does not support A words (error 20)"));
}

TEST_F(Posts, ConvertMakesArcsOfArcsAgain) {
    write_content(part, "G21 G90\nG0 X10 Y0 Z1\nG3 X-10 Y0 I-10 F600\nM2\n");
    const Ended ended = convert("router-xyz", "grbl", {"--arcs", "0.01", "--line-numbers"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("N40 G3 X-10.000 Y0.000 I-10.000 J0.000 F"));
    EXPECT_THAT(ended.err, HasSubstr("1 arc\n"));
}

/// An arc is longer than its chords by a hair; its feed is theirs.
TEST_F(Posts, ConvertKeepsTheFeedOfArcs) {
    write_content(part, "G21 G90\nG0 X10 Y0 Z1\nG3 X-10 Y0 I-10 F480\nM2\n");
    const Ended ended = convert("router-xyz", "linuxcnc-xyz", {"--arcs", "0.01"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("F480.0000"));
}

/// The thesis's own program begins at X-7, and its table at X0.
TEST_F(Posts, ConvertPutsTheZeroOfAProgramWhereItFits) {
    const std::string plate = "assets/samples/gcode/thesis-plate.ngc";
    const std::vector<std::string> words{
        "gcode", "convert", plate, "--machine", "forming-table", "--post", "linuxcnc-xyz"};
    const Ended outside = run(words);
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_THAT(outside.err, HasSubstr("axis X would have to move to -7.000"));
    auto moved = words;
    moved.insert(moved.end(), {"--origin", "10,20"});
    const Ended inside = run(moved);
    EXPECT_EQ(inside.exit_code, 0) << inside.err;
    EXPECT_THAT(inside.out, HasSubstr("X3.0000 Y33.0000"));
    moved.back() = "10,20,5.5";
    EXPECT_THAT(run(moved).out, HasSubstr("Z15.5000"));
    moved.back() = "10";
    EXPECT_NE(run(moved).exit_code, 0);
}

/// At the machine the warning on standard error is not seen.
TEST_F(Posts, AProgramOfMachinePositionsSaysSoAtItsTopForEveryPost) {
    write_content(part, "G21 G90\nS1000 M3\nG0 X1 Y1 Z5\nG1 Z-1 F100\nG53 G0 Z0\nM2\n");
    int posts = 0;
    for (const auto& entry : std::filesystem::directory_iterator("assets/posts")) {
        const Ended ended = convert("router-xyz", entry.path().string(), {"--origin", "100,100,-50"});
        if (ended.exit_code != 0) { // for machines with rotary axes
            continue;
        }
        ++posts;
        std::string text = ended.out; // some controls have capitals only
        std::ranges::transform(text, text.begin(), [](unsigned char letter) { return std::tolower(letter); });
        EXPECT_THAT(text, HasSubstr("run with a work offset of zero")) << entry.path();
        const std::string before = text.substr(0, text.find("machine positions"));
        EXPECT_LE(std::count(before.begin(), before.end(), '\n'), 2) << entry.path() << "\n" << ended.out;
    }
    EXPECT_GE(posts, 4);
}

/// A cycle always keeps to the exact path; G61 was written for all and a change reported.
TEST_F(Posts, ACannedCycleChangesNoPathMode) {
    write_content(part, "G21 G90\nG0 Z5\nG81 X1 Y1 Z-1 R2 F100\nG80\nG0 X9\nM2\n");
    Ended ended = convert("router-xyz", "linuxcnc-xyz");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("path mode")));
    EXPECT_THAT(ended.out, HasSubstr("G64 P0.005"));
    write_content(part, "G21 G90 G64 P0.02\nG0 Z5\nG81 X1 Y1 Z-1 R2 F100\nG80\nG0 X9\nM2\n");
    ended = convert("router-xyz", "linuxcnc-xyz");
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("path mode")));
    EXPECT_THAT(ended.out, HasSubstr("G64 P0.02"));
    write_content(part, "G21 G90 G64 P0.02\nG0 Z5\nG81 X1 Y1 Z-1 R2 F100\nG80\nG61\nG0 X9\nM2\n");
    EXPECT_THAT(convert("router-xyz", "linuxcnc-xyz").err, HasSubstr("the path mode (G61, G64) changes"));
}

/// Somebody else's first move may be a feed, and the machine may have no table to turn.
TEST_F(Posts, ConvertWritesTipsOfProgramsThatBeginWithAFeedForMachinesWithoutRotaryAxes) {
    write_content(part, "G21 F100\nM3 S100\nG1 X1\nM2\n");
    for (const char* machine : {"router-xyz", "forming-table"}) {
        for (const char* post : {"heidenhain", "fanuc-tcp", "linuxcnc-tcp"}) {
            const Ended ended = convert(machine, post);
            EXPECT_EQ(ended.exit_code, 0) << machine << " " << post << ": " << ended.err;
            EXPECT_THAT(ended.out, ContainsRegex("X[+]?1\\.000")) << machine << " " << post;
        }
    }
}

TEST_F(Posts, ConvertReadsFeedsOfGrblInTheUnitOfTheirOwnLine) {
    write_content(part, "G20\nG0 X0.5\nG21 G1 X50 F1000\n");
    const Ended millimetres = convert("router-xyz", "grbl", {"--dialect", "grbl"});
    EXPECT_EQ(millimetres.exit_code, 0) << millimetres.err;
    EXPECT_THAT(millimetres.out, HasSubstr("F1000.0"));
    write_content(part, "G20 G1 X3 F100\nG0 X0\nM2\n");
    EXPECT_THAT(convert("router-xyz", "grbl", {"--dialect", "grbl"}).out, HasSubstr("F2540.0"));
}

TEST_F(Posts, ConvertRefusesWhatPlannedMotionCannotDoAndTellsWhatItSaysOtherwise) {
    write_content(part, "G21 G90\nG0 X0 Y0 Z5\nG38.2 Z-20 F50\nG10 L20 P1 Z0\nG0 Z5\nM2\n");
    Ended ended = convert("router-xyz", "grbl");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, HasSubstr(":3:1: probing (G38) is not possible"));
    write_content(part, "G21 G90 S500 M3\nG0 X0 Y0 Z5\nG33.1 Z-10 K1.5\nM2\n");
    ended = convert("router-xyz", "linuxcnc");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(":3:1: spindle-synchronized feed is not possible here"));
    write_content(part, "G21 G90\nM7\nG0 X0 Y0 Z5\nG1 X9 F300\nG53 G0 Z0\nM2\n");
    ended = convert("router-xyz", "grbl");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err, HasSubstr(":5:1: G53 moves to a machine position, but the program zero"));
    ended = convert("router-xyz", "grbl", {"--origin", "1,2"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(ended.err,
                HasSubstr(":5:1: G53 moves to a machine position, but the program zero in machine "
                          "coordinates is unknown in Z (give the program zero"));
    ended = convert("router-xyz", "grbl", {"--origin", "1,2,-20"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("warning: " + part + ":2:1: mist coolant (M7)"));
    EXPECT_THAT(ended.out, HasSubstr("G0 X1.000 Y2.000 Z-15.000\nG1 X10.000 F300.0\nG0 Z0.000\n"));
}

// Millwright's own plot commands, and others, take the diameters from there.
TEST_F(Posts, ConvertKeepsTheDiametersOfTools) {
    write_content(part,
                  "(T1 D=6. CR=0. - ZMIN=-3. - FLAT END MILL)\n(T2 | 1/8 BALL ENDMILL)\nG21 G90\nT1 M6\n"
                  "G0 X0 Y0 Z5\nG1 X9 F300\nT2 M6\nG1 X0\nM2\n");
    const Ended ended = convert("router-xyz", "grbl");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, testing::StartsWith("(T1 D=6.)\n(T2 D=3.175)\n"));
}

/// A retract to a reference point that is not stored never goes down; a parameter file says where it is.
TEST_F(Posts, ConvertTakesWhatTheControllerRemembersFromAFile) {
    write_content(part, "G21 G90\nG0 X0 Y0 Z5\nG1 X9 F300\nG28 G91 Z0\nM2\n");
    const std::string remembered = (scratch / "linuxcnc.var").string();
    Ended ended = convert("router-xyz", "grbl", {"--origin", "0,0,10"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(":4:1: G28 would move Z from 15.000 to 0.000, towards the part"));
    write_content(remembered, "5163 50\n5210 0\n5221 1\n5222 2\n5223 -20\n5230 0\n");
    ended = convert("router-xyz", "grbl", {"--parameters", remembered});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("G0 X1.000 Y2.000 Z-15.000\n"));
    EXPECT_THAT(ended.out, HasSubstr("Z50.000\n"));
    write_content(part, "G21 G90\nG0 X0 Y0 Z5\nG53 G0 X0\nG53 G0 Z0\nM2\n");
    write_content(remembered, "5210 0\n5221 1\n5222 2\n");
    ended = convert("router-xyz", "grbl", {"--parameters", remembered});
    EXPECT_EQ(ended.exit_code, 1); // which counted as 0
    EXPECT_THAT(ended.err,
                HasSubstr(":3:1: G53 moves to a machine position, but the rotation of G54 is unknown"));
    write_content(remembered, "5210 0\n5221 1\n5222 2\n5230 0\n");
    ended = convert("router-xyz", "grbl", {"--parameters", remembered});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr(":4:1: G53 moves to a machine position"));
    write_content(part, "G21 G90\nG0 X0 Y0 Z5\nG0 Z[0-#5223]\nM2\n");
    ended = convert("router-xyz", "grbl", {"--parameters", remembered});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.out, "");
    EXPECT_THAT(
        ended.err,
        HasSubstr(":3:8: #5223 is an offset of G54, but its value is unknown (give the program zero"));
    EXPECT_EQ(run({"gcode", "check", part}).exit_code, 0); // rs274 takes 0
    write_content(remembered, "5163\n");
    ended = convert("router-xyz", "grbl", {"--parameters", remembered});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("linuxcnc.var:1: a line must have a parameter number and a value"));
}

/// One block had F500.1: its end is rounded, and its time was not.
TEST_F(Posts, AFeedStaysTheFeedInPositionsOfTheTip) {
    std::string text = "G21 G90\nG0 X0 Y0 Z0\nG1 F500\n";
    for (int n = 1; n <= 40; ++n) {
        text += "X" + std::to_string(n * 0.33333) + "\n";
    }
    write_content(part, text + "M2\n");
    const Ended ended = convert("router-xyz", "heidenhain");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(" F500"));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("F500.1")));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("F499.9")));
}

/// G0 without axes in the head of the thesis's program became a rapid to X0 Y0 Z0.
TEST_F(Posts, ConvertMovesNoAxisThatTheProgramHasNotNamed) {
    const Ended ended = run({"gcode",
                             "convert",
                             "assets/samples/gcode/thesis-plate.ngc",
                             "--machine",
                             "router-xyz",
                             "--post",
                             "linuxcnc-xyz"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\nG0 X-7.0000 Y13.0000\nZ10.0000\n"));
    EXPECT_THAT(ended.out, testing::Not(HasSubstr("X0.0000 Y0.0000")));
    EXPECT_THAT(ended.err, HasSubstr("the start position of Z is unknown"));
}

TEST_F(Posts, EveryCommandNamesTheAxesWhoseStartIsUnknown) {
    write_content(part, "G21 G90\nG0 X10\nG0 Y10\nG1 X11 F100\nM2\n");
    const std::string said =
        ":2: the start positions of Y and Z are unknown: X moves here, but the program sets Y "
        "for the first time in line 3, never sets Z";
    const Ended converted = convert("router-xyz", "grbl");
    EXPECT_EQ(converted.exit_code, 0) << converted.err;
    EXPECT_THAT(converted.err, HasSubstr(said));
    const Ended timed = run({"gcode", "time", part, "--machine", "router-xyz"});
    EXPECT_EQ(timed.exit_code, 0) << timed.err;
    EXPECT_THAT(timed.err, HasSubstr(said));
}

/// A feed to where the axes may or may not be has no length: it was refused.
TEST_F(Posts, ConvertWritesAFirstFeedForEveryControl) {
    write_content(part, "G21\nG1 X0 Y0 F300\nG1 X10\nM2\n");
    EXPECT_THAT(convert("router-xyz", "grbl").out, HasSubstr("\nG1 X0.000 Y0.000 F300.0\nX10.000\n"));
    EXPECT_THAT(convert("router-xyz", "linuxcnc").out,
                HasSubstr("\nG1 X0.0000 Y0.0000 F300.0000\nG93 X10.0000 F30.0000\n"));
    write_content(part, "G20\nG1 X0 Y0 F10\nX1\nM2\n");
    EXPECT_THAT(convert("router-xyz", "linuxcnc").out, HasSubstr("\nG1 X0.0000 Y0.0000 F254.0000\n"));
}

TEST_F(Posts, ConvertRefusesTipsOfAxesThatTheProgramNeverNames) {
    write_content(part, "G21 G90\nG0 X10 Y0 Z50\nG1 Z0 F600\nM2\n");
    const Ended ended = convert("ac-table", "heidenhain");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the program does not specify A before its first move"));
    EXPECT_EQ(convert("ac-table", "linuxcnc").exit_code, 0);
}

/// Ends of chords were compared with other digits than those that stand in the text.
TEST_F(Posts, ConvertWritesArcsOfInchesAsTheyAre) {
    for (const char* depth : {"0.0625", "0.03125", "0.015625", "0.4375"}) {
        write_content(part,
                      std::string("G20 G90 G17 F10\nG0 X0 Y0 Z0.25\nG1 Z-") + depth +
                          "\nG2 X0 Y0 I0.5 J0\nG2 X-0.71875 Y-0.59375 R5\nG18 G3 X0.0625 Z0.03125 R3\nG0 "
                          "Z0.25\nM2\n");
        for (const char* post : {"grbl", "linuxcnc", "linuxcnc-xyz", "virtual"}) {
            for (const char* tolerance : {"0", "0.01"}) {
                const Ended ended = convert("router-xyz", post, {"--arcs", tolerance});
                EXPECT_EQ(ended.exit_code, 0) << depth << " " << post << ": " << ended.err;
            }
        }
    }
}

TEST_F(Posts, ConvertFindsSubroutinesInTheFoldersThatAreGiven) {
    const fs::path folder = scratch / "subs";
    fs::create_directory(folder);
    write_content(folder / "hole.ngc", "o<hole> sub\nG0 Z5\no<hole> endsub\nM2\n");
    write_content(part, "G21 G90\nG0 X1 Y1 Z1\no<hole> call\nM2\n");
    EXPECT_EQ(convert("router-xyz", "grbl").exit_code, 1);
    const Ended ended = convert("router-xyz", "grbl", {"--subroutines", folder.string()});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("\nZ5.000\n"));
    EXPECT_THAT(convert("router-xyz", "grbl", {"--subroutines", part}).err,
                HasSubstr("is a file, but must be a folder"));
    EXPECT_THAT(convert("router-xyz", "grbl", {"--subroutines", scratch / "no"}).err,
                HasSubstr("there is no folder"));
}

TEST_F(Posts, ConvertSaysWhatCannotBe) {
    write_content(part, "G21 G90\nG0 X10 A5\nM2\n");
    Ended ended = convert("ac-table", "grbl");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("Grbl 1.1 moves only X Y Z, but the program for 'A-on-C table' also moves A C"));
    ended = convert("ac-table", "siemens");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(
        ended.err,
        HasSubstr("unknown post 'siemens' (known: fanuc-tcp, grbl-inch, grbl-rotary, grbl, heidenhain, "
                  "linuxcnc-inch, linuxcnc-tcp, linuxcnc-xyz-inch, linuxcnc-xyz, linuxcnc, virtual; or "
                  "give the path of a file)"));
    write_content(part, "G21 G90\nG0 Y10 A5\nG1 Z0 F600\nM2\n");
    ended = convert("ac-table", "heidenhain");
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("part.ngc:3: Heidenhain klartext with FUNCTION TCPM uses tool-tip positions, but "
                          "the program does not specify X before its first move"));
    write_content(part, "G21 G90\nG0 X10 Y0 Z0 A5 C0\nM2\n");
    ended = convert("ac-table", "heidenhain", {"--arcs", "0.01"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("cannot contain arcs"));
    write_content(part, "G21 G90\nG0 Z500\nM2\n");
    ended = convert("ac-table", "linuxcnc", {"--out", out});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("axis Z would have to move to 500.000, outside -300.000 ... 400.000 mm"));
    EXPECT_FALSE(fs::exists(out));
}

// No post wrote inches; one's own with three decimals rounded to 0.0254 mm.
TEST_F(Posts, WriteInches) {
    write_content(part, "G21 G90\nG0 X25.4 Y0 Z1\nG1 X-12.7003 F254\nM2\n");
    for (const char* const post : {"linuxcnc-inch", "linuxcnc-xyz-inch", "grbl-inch"}) {
        const Ended ended = convert("router-xyz", post);
        ASSERT_EQ(ended.exit_code, 0) << post << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("G20 G90")) << post;
        EXPECT_THAT(ended.out, HasSubstr("X1.00000")) << post;
        EXPECT_THAT(ended.out, HasSubstr("X-0.50001")) << post;
    }
    EXPECT_THAT(convert("router-xyz", "linuxcnc-xyz-inch").out, HasSubstr("F10.0000"));
}

TEST_F(Posts, TakesAPostFileOfOnesOwnAndSaysWhatIsWrongInIt) {
    write_content(part, "G21 G90\nG0 X10 Y0 Z1\nM2\n");
    const std::string shipped = content_of("assets/posts/linuxcnc.json");
    std::string own = shipped;
    own.replace(own.find("\"end\": [\"M2\"]"), 13, "\"end\": [\"M30\"]");
    const std::string file = (scratch / "own.json").string();
    write_content(file, own);
    EXPECT_THAT(convert("router-xyz", file).out, HasSubstr("\nM30\n"));
    own.replace(own.find("\"M30\""), 5, "\"M5\"");
    write_content(file, own); // such a text never says that it ends
    Ended ended = convert("router-xyz", file);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("part.ngc:4:1: the program has no end: M2, M30 or % is missing"));
    write_content(file, shipped.substr(0, 400));
    ended = convert("router-xyz", file);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("own.json:"));
}

TEST_F(Posts, PlanNamesTheProgramAfterItsControl) {
    const auto project = small_project(scratch.path(), "dome");
    const Ended ended = run({"plan", project, "--out", out, "--post", "heidenhain"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(fs::exists(fs::path(out) / "program.h"));
    EXPECT_FALSE(fs::exists(fs::path(out) / "program.ngc"));
}

/// Its control corrects the tip for any tool, and the figures of the header are those of axis moves.
TEST_F(Posts, AProgramForTipControlSaysWhatItsHeaderDoesNotHoldFor) {
    const auto project = small_project(scratch.path(), "dome", "rotary-tilt-listing", "bc-table-head");
    const char* const note = "X Y Z are positions of the tool tip, for any tool length; a distance";
    Ended ended = run({"plan", project, "--out", out, "--post", "heidenhain"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const std::string tip = content_of(fs::path(out) / "program.h");
    EXPECT_THAT(tip, HasSubstr(note));
    EXPECT_THAT(tip, HasSubstr("without tip control"));
    EXPECT_THAT(tip, HasSubstr("positions are valid for this length only"));
    ended = run({"plan", project, "--out", out, "--post", "linuxcnc"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(fs::path(out) / "program.ngc"), testing::Not(HasSubstr(note)));
}

/// One remark at the top took the place of the other.
TEST_F(Posts, AProgramForTipControlThatIsPlacedOnTheMachineSaysBoth) {
    write_content(part, "G21 G90 G94\nG0 X10 Y0 Z50 A5 C30\nG1 Z20 F600\nM2\n");
    const Ended ended = convert("ac-table", "fanuc-tcp", {"--origin", "0,0,-10"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const std::size_t tip = ended.out.find("POSITIONS OF THE TOOL TIP");
    const std::size_t machine = ended.out.find("ALL POSITIONS ARE MACHINE POSITIONS");
    EXPECT_NE(tip, std::string::npos) << ended.out;
    EXPECT_LT(machine, tip) << ended.out;
}

TEST_F(Posts, RunTakesAThreeAxisProjectToAnEmulatedController) {
    const std::string port = (scratch / "grbl").string();
    const std::string logs = (scratch / "logs").string();
    const auto project = small_project(scratch.path(), "router-dome");
    Emulator emulator(port, {"--speed", "100"});
    const Ended ended = run({"run", project, "--driver", "grbl", "--port", port, "--log", logs});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Connected to Grbl 1.1h"));
    EXPECT_THAT(ended.out, HasSubstr("blocks were executed"));
    EXPECT_EQ(emulator.stop().exit_code, 0);
}

TEST_F(Posts, RunTakesAFiveAxisProjectToAControllerWithItsAxesAlone) {
    const std::string port = (scratch / "grbl").string();
    const std::string logs = (scratch / "logs").string();
    const auto project = small_project(scratch.path(), "dome");
    {
        Emulator emulator(port, {"--firmware", "grblhal", "--axes", "XYZAB", "--speed", "100"});
        const Ended ended = run({"run", project, "--driver", "grbl", "--port", port, "--log", logs});
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("Connected to grblHAL 1.1f"));
        EXPECT_THAT(ended.out, HasSubstr("blocks were executed"));
        EXPECT_EQ(emulator.stop().exit_code, 0);
    }
    const Emulator emulator(port, {"--speed", "100"});
    Ended ended = run({"run", project, "--driver", "grbl", "--port", port, "--log", logs});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the program moves A and B, but the machine has only X, Y and Z"));
    ended = run({"run", project, "--driver", "grbl", "--home", "--port", port, "--log", logs});
    EXPECT_THAT(ended.err, HasSubstr("the program moves A and B, but the machine has only X, Y and Z"));
    ended = run({"run", project, "--driver", "grbl", "--post", "grbl", "--port", port});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("Grbl 1.1 moves only X Y Z"));
    ended = run({"run", project, "--driver", "grbl"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, HasSubstr("the grbl driver needs a port (give --port)"));
}

} // namespace
} // namespace millwright::test
