// G-code programs as plots: the samples of the KMITL master's thesis of 2006 by the same commands.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string simple = "assets/samples/gcode/thesis-simple.ngc";
const std::string space = "assets/samples/gcode/thesis-3d.ngc";
const std::string thesis_plate = "assets/samples/gcode/thesis-plate.ngc";

/// Those of a path file: x, y, z, speed, move, tool.
std::vector<std::vector<std::string>> path_records(const std::string& path_file) {
    std::istringstream in(path_file);
    std::vector<std::vector<std::string>> records;
    for (std::string line; std::getline(in, line);) {
        std::istringstream fields(line);
        records.emplace_back();
        for (std::string field; std::getline(fields, field, ',');) {
            records.back().push_back(field);
        }
    }
    records.erase(records.begin()); // the title
    return records;
}

TEST(ProgramsAsPlots, InfoTellsWaysAndTimesOfTheThesis) {
    struct Known {
        std::string file;
        double feed, feed_s, rapid;
        std::array<double, 4> extents;
        double z;
    };
    for (const Known& known : {Known{simple, 74.0, 148.0, 28.2842, {10, 10, 22, 20}, -10},
                               Known{space, 438.2848, 81.828, 80.2905, {10, 10, 90, 90}, 0},
                               Known{thesis_plate, 579.8006, 1159.601, 106.2665, {-7, -7, 110, 110}, -2}}) {
        const Ended ended = run({"plot", "info", known.file, "--json", "--arc-tolerance", "0.0001"});
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const auto told = nlohmann::json::parse(ended.out);
        EXPECT_NEAR(told.at("feed_mm"), known.feed, 2e-3) << known.file;
        EXPECT_NEAR(told.at("feed_s"), known.feed_s, 3e-3) << known.file;
        EXPECT_NEAR(told.at("rapid_mm"), known.rapid, 1e-4) << known.file;
        EXPECT_NEAR(told.at("time_s"), known.feed_s + known.rapid / 10.0, 3e-3) << known.file;
        EXPECT_EQ(told.at("extents_mm"), nlohmann::json(known.extents)) << known.file;
        EXPECT_EQ(told.at("z_mm"), nlohmann::json({known.z, known.z})) << known.file;
    }
    EXPECT_EQ(run({"plot", "info", space}).out,
              "24 lines, 2 strokes at 1 level, 1 tool\n"
              "x 10.000 to 90.000 mm, y 10.000 to 90.000 mm, z 0.000 to 0.000 mm\n"
              "feed moves across from z 10.000 mm up are travel\n"
              "0.469 m (0.418 m drawn, 0.050 m travel), 2 lifts\n"
              "0.438 m at feed rate in 1:22 min, 0.080 m at rapid; 1:30 min with rapids of 10 mm/s\n");
}

// As rs274 has it: 252.891 mm; lowered by 5 mm that the program does not say it were 257.883.
TEST(ProgramsAsPlots, InfoCountsNoWayThatTheProgramDoesNotSay) {
    const std::string file = "assets/samples/gcode/compensation-right.ngc";
    const auto told = nlohmann::json::parse(run({"plot", "info", file, "--json"}).out);
    EXPECT_NEAR(told.at("feed_mm"), 252.89, 0.02);
    EXPECT_NEAR(told.at("feed_s"), told.at("feed_mm").get<double>() / 5.0, 1e-3);
    EXPECT_THAT(told.at("diagnostics").at(0).at("message"), HasSubstr("no height is given"));
    EXPECT_THAT(run({"plot", "info", file}).out, HasSubstr("every feed move across is a cut\n"));
    EXPECT_THAT(run({"plot", "info", file}).err, HasSubstr("compensation-right.ngc:5: no height"));
}

// n = 41, 15, 27 and 17 parts of 1 mm are what the rule of the thesis makes of the four arcs.
TEST(ProgramsAsPlots, ToolpathKeepsHeightsAndFeedsAndCutsArcsByTheRuleOfTheThesis) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.ngc").string();
    const std::string path = (folder / "out.path").string();
    const Ended ended = run({"plot", "toolpath", space, "--out", out, "--path", path, "--chord-length", "1"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto records = path_records(content_of(path));
    const auto cuts = std::ranges::count_if(records, [](const auto& record) { return record[4] == "cut"; });
    EXPECT_EQ(cuts, 4 + 41 + 15 + 27 + 17);
    EXPECT_EQ(records[0], (std::vector<std::string>{"10", "10", "10", "0", "rapid", "1"}));
    EXPECT_EQ(records[1], (std::vector<std::string>{"10", "10", "0", "0.5", "plunge", "1"}));
    EXPECT_EQ(records[2], (std::vector<std::string>{"90", "10", "0", "10", "cut", "1"}));
    EXPECT_EQ(run({"gcode", "check", out}).exit_code, 0);
    const Ended again = run({"plot", "info", out, "--json"});
    EXPECT_EQ(nlohmann::json::parse(again.out).at("strokes"), 2);
}

TEST(ProgramsAsPlots, WhatShapesStrokesCutsThemAnewAtTheirDepth) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.ngc").string();
    const std::string path = (folder / "out.path").string();
    const Ended ended = run({"plot",
                             "toolpath",
                             thesis_plate,
                             "--out",
                             out,
                             "--path",
                             path,
                             "--origin",
                             "50,50",
                             "--side",
                             "outside",
                             "--tool-diameter",
                             "4"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("as drawn:"));
    double leftmost = 1e9;
    for (const auto& record : path_records(content_of(path))) {
        leftmost = std::min(leftmost, std::stod(record[0]));
        EXPECT_TRUE(record[2] == "-2" || record[2] == "10") << record[2];
    }
    EXPECT_NEAR(leftmost, 50.0 - 7.0 - 2.0, 1e-3);
    const Ended high = run({"plot", "toolpath", simple, "--out", out, "--path", path, "--depth", "4"});
    ASSERT_EQ(high.exit_code, 0) << high.err;
    EXPECT_THAT(content_of(path), HasSubstr(",-4,"));
}

// An origin without Z: the retract by G53 became a rapid to Z0 of the work.
TEST(ProgramsAsPlots, AnOriginWithoutZPlacesNothingInZ) {
    const ScratchFolder folder;
    const std::string part = (folder / "part.ngc").string();
    const std::string out = (folder / "out.ngc").string();
    write_content(part, "G21 G90 M3 S100\nG0 X1 Y1 Z50\nG1 Z40 F100\nX20\nG53 G0 Z0\nG0 X90\nM2\n");
    const auto cut = [&](const char* origin) {
        return run(
            {"plot", "toolpath", part, "--work-origin", origin, "--machine", "router-xyz", "--out", out});
    };
    EXPECT_EQ(cut("10,10").exit_code, 1);
    EXPECT_THAT(cut("10,10").err,
                HasSubstr(":5:1: G53 moves to a machine position, but the program zero in machine "
                          "coordinates is unknown in Z"));
    EXPECT_EQ(cut("10,10,-60").exit_code, 0) << cut("10,10,-60").err;
}

/// Heights at which the tool goes across at rapid.
std::set<std::string> travel_heights(const std::vector<std::vector<std::string>>& records) {
    std::set<std::string> heights;
    for (std::size_t n = 1; n < records.size(); ++n) {
        const bool across = records[n][0] != records[n - 1][0] || records[n][1] != records[n - 1][1];
        if (records[n][4] == "rapid" && across) {
            heights.insert(records[n][2]);
        }
    }
    return heights;
}

// What it travels over, a clamp, is not in the program.
TEST(ProgramsAsPlots, ACutAnewTravelsNoLowerThanTheProgram) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.ngc").string();
    const std::string path = (folder / "out.path").string();
    const std::string two_cuts = "G1 Z-1 F100\nG1 X30 F300\nG0 Z2\nG0 X10 Y20\nG1 Z-1\nG1 X30\n";
    const std::string over = (folder / "over.ngc").string();
    const std::string once = (folder / "once.ngc").string();
    const std::string slow = (folder / "slow.ngc").string();
    const std::string low = (folder / "low.ngc").string();
    write_content(over, "G0 Z20\nG0 X10 Y10\n" + two_cuts + "G0 Z20\nG0 X0\nM2\n");
    write_content(once, "G0 X10 Y10 Z20\n" + two_cuts + "G0 Z30\nM2\n");
    write_content(slow, "G0 Z2\nG0 X10 Y10\n" + two_cuts + "G1 Z20\nG1 X0\nG0 Z30\nM2\n");
    write_content(low, "G0 Z2\nG0 X10 Y10\n" + two_cuts + "G0 Z2\nM2\n");
    for (const std::string& file : {over, once, slow, low}) {
        std::vector<std::string> words{"plot", "toolpath", file, "--out", out, "--path", path, "--order"};
        const Ended ended = run(words);
        ASSERT_EQ(ended.exit_code, 0) << ended.err;
        const std::set<std::string> heights = travel_heights(path_records(content_of(path)));
        EXPECT_EQ(heights, std::set<std::string>{file == low ? "5" : "20"}) << file;
        const std::string told = "the tool travels at 20.000 mm, as high as in the program";
        EXPECT_EQ(ended.err.find(told) != std::string::npos, file != low) << ended.err;
        words.insert(words.end(), {"--safe-height", "4"});
        ASSERT_EQ(run(words).exit_code, 0);
        EXPECT_EQ(travel_heights(path_records(content_of(path))), std::set<std::string>{"4"}) << file;
    }
}

TEST(ProgramsAsPlots, PointsHaveTheHeightsOfTheProgramOrThoseOfThePen) {
    const ScratchFolder folder;
    const std::string out = (folder / "points.csv").string();
    std::vector<std::string> words{"plot",
                                   "decode",
                                   simple,
                                   "--velocity",
                                   "10",
                                   "--period",
                                   "0.1",
                                   "--mode",
                                   "path",
                                   "--out",
                                   out,
                                   "--decimals",
                                   "3"};
    ASSERT_EQ(run(words).exit_code, 0);
    const std::string points = content_of(out);
    EXPECT_THAT(points, HasSubstr("\n10.000,10.000,0.000\n10.000,10.000,-1.000\n"));
    EXPECT_THAT(points, HasSubstr("\n10.000,10.000,-10.000\n11.000,10.000,-10.000\n"));
    EXPECT_TRUE(points.ends_with("0.000,0.000,10.000\n"));
    words.insert(words.end(), {"--pen-up", "2"});
    ASSERT_EQ(run(words).exit_code, 0);
    EXPECT_THAT(content_of(out), HasSubstr("\n11.000,10.000,0.000\n"));
    EXPECT_THAT(content_of(out), Not(HasSubstr("-10.000")));
    EXPECT_TRUE(content_of(out).ends_with("0.000,0.000,2.000\n"));
}

TEST(ProgramsAsPlots, SubroutinesBesideTheProgramAreFound) {
    const ScratchFolder folder;
    write_content(folder / "cut.ngc", "O<cut> sub\nG1 Z-1 F60\nG1 X[#1 + 9]\nG0 Z5\nO<cut> endsub\nM2\n");
    write_content(folder / "main.ngc", "G0 Z5\nG0 X0 Y0\nO<cut> call [1]\nG0 Y4\nO<cut> call [2]\nM2\n");
    const Ended ended = run({"plot", "info", (folder / "main.ngc").string(), "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(nlohmann::json::parse(ended.out).at("strokes"), 2);
}

TEST(ProgramsAsPlots, IsDrawnByItsStrokes) {
    const ScratchFolder folder;
    const std::string out = (folder / "plate.svg").string();
    EXPECT_EQ(run({"plot", "view", thesis_plate, "--out", out}).out, "2 strokes at 1 level, 1 tool\n");
    EXPECT_THAT(content_of(out), HasSubstr("<svg"));
}

TEST(ProgramsAsPlots, WhatIsNoPathIsRefusedWithTheLine) {
    const ScratchFolder folder;
    const std::string out = (folder / "out").string();
    write_content(folder / "turn.ngc", "G0 X0 Y0 Z5\nG1 Z-1 F60\nG1 X9 B20\nM2\n");
    write_content(folder / "ramp.ngc", "G0 X0 Y0 Z5\nG1 Z0 F60\nG1 X9 Z-2\nG0 Z5\nX0\nM2\n");
    const std::string turn = (folder / "turn.ngc").string();
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"plot", "info", turn},
                                               {"plot", "info", turn, "--json"},
                                               {"plot", "view", turn, "--out", out},
                                               {"plot", "toolpath", turn, "--out", out}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr("turn.ngc:3:7: the machine 'X, Y, Z' has no axis B"));
        EXPECT_EQ(ended.out, "");
    }
    const std::string ramp = (folder / "ramp.ngc").string();
    EXPECT_EQ(run({"plot", "toolpath", ramp, "--out", out}).exit_code, 0);
    std::filesystem::remove(out);
    const Ended ended = run({"plot", "toolpath", ramp, "--out", out, "--order"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(
        ended.err,
        HasSubstr("ramp.ngc:3: this cut changes height from z 0.000 to -2.000 mm: --order applies only to"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

// A rapid to X0 Y0 and a cut from there were added without a word.
TEST(ProgramsAsPlots, ACutFromAnUnknownPlaceIsRefusedWithItsLine) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "41.ngc").string();
    const std::string out = (scratch / "o.ngc").string();
    write_content(file, "G21 G90\nM3 S1000\nG0 Z5\nG1 Z-1 F100\nG1 X50\nG0 Z5\nM2\n");
    const Ended ended = run({"plot", "toolpath", file, "--out", out, "--machine", "router-xyz"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("41.ngc:4: this cut starts before the program has stated where X and Y are (add a "
                          "rapid move with X and Y before the first cut)"));
    EXPECT_FALSE(std::filesystem::exists(out));
    EXPECT_EQ(run({"plot", "decode", file, "--velocity", "10", "--period", "0.01", "--out", out}).exit_code,
              1);
    const Ended info = run({"plot", "info", file});
    EXPECT_EQ(info.exit_code, 0);
    EXPECT_THAT(info.err, HasSubstr("this cut starts before the program has stated")) << "only looked at";
}

TEST(ProgramsAsPlots, OptionsOfTheOtherKindOfFileAreRefused) {
    EXPECT_EQ(run({"plot", "info", thesis_plate, "--unit", "table"}).exit_code, 2);
    EXPECT_EQ(run({"plot", "info", thesis_plate, "--strict"}).exit_code, 2);
    EXPECT_EQ(run({"plot", "info", thesis_plate, "--chord-length", "1", "--arc-tolerance", "0.1"}).exit_code,
              2);
    const Ended ended = run({"plot", "info", "assets/samples/plot/arcs.plt", "--chord-length", "1"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.err, HasSubstr("--chord-length applies only to G-code programs"));
}

TEST(ProgramsAsPlots, TheToolIsAsWideAsACommentSays) {
    const ScratchFolder folder;
    const std::string program = (folder / "cam.nc").string();
    write_content(folder / "cam.nc",
                  "(T1 D=4. CR=0. - FLAT END MILL)\nG21 G90\nT1 M6\nG0 X10 Y10 Z5\nG1 Z-1 F100\n"
                  "X30\nG0 Z5\nM30\n");
    const auto made = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"plot", "toolpath", program, "--out", (folder / "o.ngc").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    EXPECT_THAT(made({}), HasSubstr("cam.nc:1: the tool diameter is 4 mm according to a comment"));
    EXPECT_THAT(made({"--tool-diameter", "3"}), Not(HasSubstr("according to a comment")));
    write_content(folder / "cam.nc",
                  "(T1 D=4.)\n(T2 D=6.)\nG21 G90\nT1 M6\nG0 X10 Y10 Z5\nG1 Z-1 F100\nX30\nT2 M6\nX50\nM30\n");
    EXPECT_THAT(made({}), HasSubstr("cam.nc:2: comments name tools of several diameters"));
    EXPECT_THAT(made({"--tool-diameter", "3"}), Not(HasSubstr("several diameters")));
}

} // namespace
} // namespace millwright::test
