#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string sample = "assets/samples/plot/autocad-7475.plt";

TEST(PlotCommand, DecodeWritesThePointFileOfTheThesis) {
    const ScratchFolder folder;
    write_content(folder / "line.plt", "IN;SP1;PU0,0;PD400,400;PU;SP;");
    const Ended ended = run({"plot",
                             "decode",
                             (folder / "line.plt").string(),
                             "--velocity",
                             "40",
                             "--period",
                             "0.01",
                             "--out",
                             (folder / "points.csv").string()});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(ended.out, "36 points, 0.350 s\n");
    const std::string points = content_of(folder / "points.csv");
    EXPECT_EQ(std::ranges::count(points, '\n'), 36);
    EXPECT_TRUE(points.starts_with("0.00,0.00,0.00\n0.29,0.29,0.00\n0.57,0.57,0.00\n"));
    EXPECT_TRUE(points.ends_with("9.71,9.71,0.00\n10.00,10.00,0.00\n"));
}

TEST(PlotCommand, InfoCountsOneAndMany) {
    const ScratchFolder folder;
    const auto first_line = [&](const std::string& plot) {
        write_content(folder / "drawn.plt", plot);
        const std::string said = run({"plot", "info", (folder / "drawn.plt").string()}).out;
        return said.substr(0, said.find('\n'));
    };
    EXPECT_EQ(first_line("PD400,400;"), "1 command, 1 stroke of 1 pen");
    EXPECT_EQ(first_line("SP1;PD400,400;PU;PA0,0;SP2;PD0,400;"), "6 commands, 2 strokes of 2 pens");
}

struct Told {
    double way = 0.0;  ///< mm
    std::string clock; ///< "32:52 min"
};

/// "... points: 8.1 m at feed rate, 0.4 m at rapid ... 32:52 min on the machine".
Told told_by_toolpath(const std::string& out) {
    double feed = 0.0;
    double rapid = 0.0;
    const std::string figures = out.substr(out.find(" points: ") + 9);
    EXPECT_EQ(std::sscanf(figures.c_str(), "%lf m at feed rate, %lf m at rapid", &feed, &rapid), 2) << out;
    const std::size_t end = out.rfind(" on ");
    const std::size_t begin = out.rfind(", ", end) + 2;
    return {1000.0 * (feed + rapid), out.substr(begin, end - begin)};
}

/// "00:32:52 (1971.020 s), 8500.1 mm, 2067 blocks".
Told told_by_gcode_time(const std::string& out) {
    Told told;
    const std::string figures = out.substr(out.find("s), ") + 4);
    EXPECT_EQ(std::sscanf(figures.c_str(), "%lf mm", &told.way), 1) << out;
    int minutes = 0;
    int seconds = 0;
    EXPECT_EQ(std::sscanf(out.c_str(), "00:%d:%d", &minutes, &seconds), 2) << out;
    told.clock = fmt::format("{}:{:02} min", minutes, seconds);
    return told;
}

// What it says of its path is what the program does, which `gcode time` reads back, the way to its beginning
// as well: with corners that are rounded as the control is configured to, or followed exactly by one that is
// not.
TEST(PlotCommand, ToolpathIsAsLongAndTakesAsLongAsItsProgram) {
    const ScratchFolder folder;
    const std::string line = (folder / "line.plt").string();
    write_content(line, "IN;SP1;PU200,200;PD4200,200;PU;SP;");
    const std::string sign = "assets/samples/plot/thesis-sign.plt";
    const std::vector<std::vector<std::string>> jobs{{line, "--origin", "3,4"},
                                                     {sign, "--link", "3"},
                                                     {sign, "--link", "3", "--post", "grbl"},
                                                     {"assets/samples/plot/figures.plt", "--order"}};
    for (const auto& job : jobs) {
        SCOPED_TRACE(testing::PrintToString(job));
        const std::string file = (folder / "out.ngc").string();
        std::vector<std::string> words{"plot", "toolpath", "--out", file};
        words.insert(words.end(), job.begin(), job.end());
        const Ended made = run(words);
        ASSERT_EQ(made.exit_code, 0) << made.err;
        const Ended timed = run({"gcode", "time", file, "--machine", "forming-table"});
        ASSERT_EQ(timed.exit_code, 0) << timed.err;
        const Told of_path = told_by_toolpath(made.out);
        const Told of_program = told_by_gcode_time(timed.out);
        EXPECT_EQ(of_path.clock, of_program.clock) << made.out << timed.out;
        EXPECT_NEAR(of_path.way, of_program.way, 1.1); // each in whole millimetres
        const std::string last = made.out.substr(0, made.out.find(" points: "));
        EXPECT_THAT(last, HasSubstr(of_path.clock + " by the planner\n"));
    }
}

TEST(PlotCommand, InfoAnswersInJson) {
    const ScratchFolder folder;
    write_content(folder / "square.plt",
                  "IN;SP2;PU400,400;PD4400,400,4400,4400,400,4400,400,400;PU0,0;QX;OI;SP;");
    const Ended ended = run({"plot", "info", (folder / "square.plt").string(), "--json"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto answer = nlohmann::json::parse(ended.out);
    EXPECT_EQ(answer.at("commands"), 7);
    EXPECT_EQ(answer.at("pens"), nlohmann::json({2}));
    EXPECT_EQ(answer.at("extents_mm"), nlohmann::json({10.0, 10.0, 110.0, 110.0}));
    EXPECT_DOUBLE_EQ(answer.at("draw_mm"), 400.0);
    EXPECT_NEAR(answer.at("air_mm").get<double>(), 2.0 * 14.142136, 1e-5);
    EXPECT_NEAR(answer.at("time_s").get<double>(), 200.0 + 2.8284271 + 6.0, 1e-5);
    ASSERT_EQ(answer.at("diagnostics").size(), 1U);
    EXPECT_EQ(answer.at("diagnostics")[0].at("byte"), 61);
    EXPECT_EQ(answer.at("left_out")[0].at("command"), "OI");
    EXPECT_TRUE(answer.at("pen_use")[0].at("speed_mm_s").is_null()); // nothing was said
}

TEST(PlotCommand, ToolpathIsAProgramWithoutErrors) {
    const ScratchFolder folder;
    const std::string file = (folder / "plate.ngc").string();
    const Ended ended = run({"plot", "toolpath", sample, "--link", "3.0", "--order", "--out", file});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("linked: "));
    EXPECT_EQ(run({"gcode", "check", file}).exit_code, 0);
    EXPECT_EQ(run({"gcode", "time", file, "--machine", "forming-table"}).exit_code, 0);
}

// One drawing, one distance: info, its JSON and the first line of toolpath.
TEST(PlotCommand, SaysOneDistanceEverywhere) {
    const ScratchFolder folder;
    for (const char* name : {"thesis-sign", "moves", "figures"}) {
        SCOPED_TRACE(name);
        const std::string file = std::string("assets/samples/plot/") + name + ".plt";
        const auto answer = nlohmann::json::parse(run({"plot", "info", file, "--json"}).out);
        const double drawn = answer.at("draw_mm"), air = answer.at("air_mm"), lifts = answer.at("lifts");
        EXPECT_NEAR(answer.at("time_s").get<double>(), drawn / 2.0 + air / 10.0 + 6.0 * lifts, 1e-6);
        const std::string told = fmt::format("{:.3f} m ({:.3f} m drawn, {:.3f} m travel), {} lifts, ",
                                             (drawn + air) / 1000.0,
                                             drawn / 1000.0,
                                             air / 1000.0,
                                             lifts);
        EXPECT_THAT(run({"plot", "info", file}).out, HasSubstr(told));
        EXPECT_THAT(run({"plot", "toolpath", file, "--out", (folder / "out.ngc").string()}).out,
                    HasSubstr("as drawn: " + told));
    }
}

TEST(PlotCommand, OrderBringsTheToolToTheNearestCornerOfAClosedStroke) {
    const ScratchFolder folder;
    std::string shapes = "IN;SP1;";
    for (const int x : {4400, 400, 2400}) {
        shapes += fmt::format("PU{0},{1};PD{2},{1},{2},{3},{0},{3},{0},{1};", x + 800, 1200, x, 400);
    }
    write_content(folder / "shapes.plt", shapes + "PU0,0;SP0;");
    const Ended ended = run({"plot",
                             "toolpath",
                             (folder / "shapes.plt").string(),
                             "--side",
                             "outside",
                             "--order",
                             "--out",
                             (folder / "out.ngc").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const std::size_t ordered = ended.out.find("ordered: ");
    ASSERT_NE(ordered, std::string::npos) << ended.out;
    // Along the lower edges to the third shape and back to the origin.
    EXPECT_THAT(ended.out.substr(ordered), HasSubstr("0.218 m travel")) << ended.out;
}

// Each was read as a plot, with a diagnostic for each of its words.
TEST(PlotCommand, FilesThatAreNoPlotsAreTakenForWhatTheyAre) {
    const ScratchFolder folder;
    const std::string out = (folder / "out").string();
    write_content(folder / "other.path",
                  "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool\n");
    const std::vector<std::array<std::string, 3>> others{
        {(folder / "other.path").string(), "this is a path file, not a plot", "millwright send"},
        {"assets/samples/pictures/boat.png", "this is a picture, not a plot", "millwright picture relief"}};
    for (const auto& [file, what, hint] : others) {
        for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
                 {"info", file},
                 {"info", file, "--json"},
                 {"view", file, "--out", out},
                 {"toolpath", file, "--out", out},
                 {"decode", file, "--velocity", "5", "--period", "1", "--out", out}}) {
            std::vector<std::string> words{"plot"};
            words.insert(words.end(), command.begin(), command.end());
            const Ended ended = run(words);
            EXPECT_EQ(ended.exit_code, 1) << file;
            EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
            EXPECT_THAT(ended.err, HasSubstr(what));
            EXPECT_THAT(ended.err, HasSubstr(hint));
            EXPECT_FALSE(std::filesystem::exists(out));
        }
    }
}

// The head of AutoCAD's files, and plots that begin with a line end, a blank or small letters.
TEST(PlotCommand, PlotsAreTakenForPlots) {
    const ScratchFolder folder;
    for (const char* text : {"\x1b.(\x1b.I81;;17:\x1b.N;19:IN;SP1;PD400,0;",
                             "\r\n  in;sp1;pd400,0;",
                             "\x1b%-12345X@PJL\r\nIN;SP1;PD400,0;",
                             "PD400,0;"}) {
        write_content(folder / "line.plt", text);
        EXPECT_EQ(run({"plot", "info", (folder / "line.plt").string()}).exit_code, 0) << text;
    }
}

TEST(PlotCommand, WritesOverNothingThatItReads) {
    const ScratchFolder folder;
    const std::string file = (folder / "line.plt").string();
    const std::string plot = "IN;SP1;PU0,0;PD400,400;PU;SP;";
    write_content(file, plot);
    std::filesystem::create_symlink(file, folder / "link.plt");
    const std::string link = (folder / "link.plt").string();
    for (const std::vector<std::string>& command : std::vector<std::vector<std::string>>{
             {"plot", "decode", file, "--velocity", "40", "--period", "0.01", "--out", file},
             {"plot", "decode", file, "--velocity", "40", "--period", "0.01", "--out", link},
             {"plot", "view", link, "--out", file},
             {"plot", "toolpath", file, "--out", file},
             {"plot", "toolpath", file, "--out", (folder / "o.ngc").string(), "--path", file}}) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr("would overwrite FILE, which is an input file"));
        EXPECT_EQ(content_of(file), plot);
    }
    const std::string out = (folder / "o.ngc").string();
    EXPECT_THAT(run({"plot", "toolpath", file, "--out", out, "--path", out}).err,
                HasSubstr("name the same file"));
    EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(PlotCommand, RefusesNumbersThatAreNone) {
    const ScratchFolder folder;
    const std::string out = (folder / "out.ngc").string();
    const auto refused = [&](const std::string& option, const std::string& value) {
        const Ended ended = run({"plot", "toolpath", sample, "--out", out, option, value});
        EXPECT_EQ(ended.exit_code, 2) << option << " " << value;
        EXPECT_THAT(ended.err, HasSubstr(option));
        EXPECT_FALSE(std::filesystem::exists(out));
    };
    for (const char* option :
         {"--link", "--depth", "--hatch", "--feed", "--tool-diameter", "--safe-height"}) {
        refused(option, "nan");
        refused(option, "-1");
    }
    for (const char* option : {"--hatch", "--contours", "--passes", "--feed", "--plate"}) {
        refused(option, "0");
    }
    for (const char* option : {"--velocity", "--period", "--travel-velocity"}) {
        std::vector<std::string> command = {
            "plot", "decode", sample, "--velocity", "40", "--period", "0.01", "--out", out};
        command.insert(command.end(), {option, "0"});
        if (std::string(option) != "--travel-velocity") {
            command = {"plot", "decode", sample, "--out", out, option, "0"};
        }
        EXPECT_EQ(run(command).exit_code, 2) << option;
    }
    EXPECT_EQ(run({"plot", "play", sample, "--period", "0"}).exit_code, 2);
}

TEST(PlotCommand, SaysThatNothingIsClosedWhereItIsToBeFilled) {
    const ScratchFolder folder;
    write_content(folder / "open.plt", "IN;SP1;PU40,40;PD440,40,440,440;PU;SP;");
    const Ended ended = run({"plot",
                             "toolpath",
                             (folder / "open.plt").string(),
                             "--hatch",
                             "1.5",
                             "--out",
                             (folder / "out.ngc").string()});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err, HasSubstr("no stroke is closed, so nothing is filled or compensated"));
}

// An outline of four LINE entities was cut on the line, with a notice: 3 mm too small.
TEST(PlotCommand, AnOutlineOfLinesIsCompensatedAndWhatIsNoOutlineRefused) {
    const ScratchFolder folder;
    const std::string lines = "PU0,0;PD4000,0;PU4000,0;PD4000,4000;PU4000,4000;PD0,4000;";
    const auto outside = [&](const std::string& plot) {
        write_content(folder / "square.plt", "IN;SP1;" + plot + "PU;SP;");
        return run({"plot",
                    "toolpath",
                    (folder / "square.plt").string(),
                    "--side",
                    "outside",
                    "--origin",
                    "10,10",
                    "--out",
                    (folder / "out.ngc").string()});
    };
    const Ended closed = outside(lines + "PU0,4000;PD0,0;");
    EXPECT_EQ(closed.exit_code, 0) << closed.err;
    EXPECT_THAT(closed.out, HasSubstr("0.412 m drawn"));
    std::filesystem::remove(folder / "out.ngc");
    const Ended open = outside(lines);
    EXPECT_EQ(open.exit_code, 1);
    EXPECT_THAT(open.err, HasSubstr("no stroke is closed"));
    EXPECT_FALSE(std::filesystem::exists(folder / "out.ngc"));
}

TEST(PlotCommand, SaysThatNothingKeepsLinksInside) {
    const ScratchFolder folder;
    write_content(folder / "hatch.plt", "IN;SP1;PU0,0;PD400,0;PU400,60;PD0,60;PU;SP;");
    const auto linked = [&](std::vector<std::string> more) {
        std::vector<std::string> words{"plot",
                                       "toolpath",
                                       (folder / "hatch.plt").string(),
                                       "--link",
                                       "3",
                                       "--out",
                                       (folder / "out.ngc").string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words).err;
    };
    EXPECT_THAT(linked({"--inside"}), HasSubstr("no stroke is closed, so links are not kept inside"));
    EXPECT_THAT(linked({}), Not(HasSubstr("no stroke is closed")));
}

// The way is the one that info counts, and the tool does not stay in the work.
TEST(PlotCommand, DecodeGoesToWhereTheFileLeavesThePen) {
    const ScratchFolder folder;
    write_content(folder / "line.plt", "IN;SP1;PU0,0;PD400,400;PU;PA0,0;SP;");
    const Ended ended = run({"plot",
                             "decode",
                             (folder / "line.plt").string(),
                             "--velocity",
                             "40",
                             "--period",
                             "0.01",
                             "--pen-up",
                             "2",
                             "--out",
                             (folder / "points.csv").string()});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_TRUE(content_of(folder / "points.csv").ends_with("0.00,0.00,2.00\n"));
}

TEST(PlotCommand, SaysWhatIsTooNarrowForTheTool) {
    const ScratchFolder folder;
    write_content(folder / "two.plt",
                  "IN;SP1;PU0,0;PD800,0,800,800,0,800,0,0;PU1200,0;PD1240,0,1240,800,1200,800,1200,0;PU;SP;");
    const Ended ended = run({"plot",
                             "toolpath",
                             (folder / "two.plt").string(),
                             "--side",
                             "inside",
                             "--out",
                             (folder / "out.ngc").string()});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err, HasSubstr("1 closed area is too narrow for the tool and is not cut"));
}

TEST(PlotCommand, InfoOfNoPlotFails) {
    const ScratchFolder folder;
    const auto info_of = [&](const std::string& bytes, std::vector<std::string> more) {
        write_content(folder / "file.plt", bytes);
        std::vector<std::string> command = {"plot", "info", (folder / "file.plt").string()};
        command.insert(command.end(), more.begin(), more.end());
        return run(command);
    };
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{}, {"--json"}}) {
        EXPECT_EQ(info_of("", more).exit_code, 1);
        EXPECT_THAT(info_of("", more).err,
                    HasSubstr("it contains no HPGL command, and does not begin as G-code"));
        EXPECT_THAT(info_of(std::string(1000, '\xff'), more).err, HasSubstr("contains no HPGL command"));
        EXPECT_THAT(info_of("IN;SP1;PU;SP;", more).err, HasSubstr("it contains nothing to draw"));
    }
    EXPECT_EQ(nlohmann::json::parse(info_of("IN;SP1;", {"--json"}).out).at("extents_mm"), nullptr);
}

// A square of 100 mm and a tool of 3 mm: 412 mm around, as in the thesis.
TEST(PlotCommand, ToolpathGoesAroundItsPartWithTheToolOutside) {
    const ScratchFolder folder;
    const std::string file = (folder / "square.ngc").string();
    write_content(folder / "square.plt", "IN;SP1;PU400,400;PD4400,400,4400,4400,400,4400,400,400;PU;SP;");
    const Ended ended = run({"plot",
                             "toolpath",
                             (folder / "square.plt").string(),
                             "--side",
                             "outside",
                             "--tool-diameter",
                             "3",
                             "--level",
                             "1:depth=2,passes=2",
                             "--out",
                             file});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("by the planner"));
    const std::string text = content_of(file);
    for (const char* word :
         {"X8.5000", "X111.5000", "Y8.5000", "Y111.5000", "Z-1.0000", "Z-2.0000", "F480.0000"}) {
        EXPECT_THAT(text, HasSubstr(word));
    }
    EXPECT_THAT(
        run({"plot", "toolpath", (folder / "square.plt").string(), "--level", "7:depth=2", "--out", file})
            .err,
        HasSubstr("pen 7 draws nothing"));
}

TEST(PlotCommand, ToolpathOfPensThatAreAllOffIsRefused) {
    const ScratchFolder folder;
    write_content(folder / "line.plt", "IN;SP1;PU200,200;PD4200,200;PU;SP;");
    const std::string file = (folder / "line.ngc").string();
    const Ended ended =
        run({"plot", "toolpath", (folder / "line.plt").string(), "--level", "1:off", "--out", file});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("there is nothing to cut"));
    EXPECT_FALSE(std::filesystem::exists(file));
}

TEST(PlotCommand, ToolpathHatchesClosedStrokes) {
    const ScratchFolder folder;
    const std::string file = (folder / "square.ngc").string();
    write_content(folder / "square.plt", "IN;SP1;PU40,40;PD440,40,440,440,40,440,40,40;PU;SP;");
    const auto runs = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {
            "plot", "toolpath", (folder / "square.plt").string(), "--out", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments).out;
    };
    // 40 mm of the square and 1.414 mm from the origin to it, where it stays: 20 s, 0.14 s, 6 s for the lift:
    // in whole seconds 27, as a clock tells it.
    EXPECT_THAT(
        runs({}),
        HasSubstr("0.041 m (0.040 m drawn, 0.001 m travel), 1 lift, 0:27 min by the thesis's formula, "));
    EXPECT_THAT(runs({"--hatch", "1.5"}),
                HasSubstr(", 8 lifts")); // the square, lines at 1.5, 3, ... 10.5
    EXPECT_THAT(runs({"--hatch", "1.5", "--hatch-cross"}), HasSubstr(", 15 lifts"));
    EXPECT_THAT(runs({"--contours", "2"}), HasSubstr(" lifts, "));
    EXPECT_THAT(runs({"--hatch", "1.5", "--link", "3"}), HasSubstr("linked: "));
}

// The thesis's machine has 480 x 550 mm from its zero on.
TEST(PlotCommand, ToolpathKeepsToTheTravelOfItsMachine) {
    const ScratchFolder folder;
    const std::string file = (folder / "line.ngc").string();
    write_content(folder / "line.plt", "IN;SP1;PU0,0;PD16000,0;PU;SP;"); // 400 mm
    const auto at = [&](const std::string& origin) {
        return run({"plot",
                    "toolpath",
                    (folder / "line.plt").string(),
                    "--machine",
                    "forming-table",
                    "--origin",
                    origin,
                    "--path",
                    (folder / "line.path").string(),
                    "--out",
                    file});
    };
    EXPECT_THAT(at("100,0").err,
                HasSubstr("axis X would have to move to 500.000, outside 0.000 ... 480.000"));
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_THAT(at("0,-1").err, HasSubstr("axis Y would have to move to -1.000"));
    const Ended ended = at("80,10");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(file), HasSubstr("X480.0000"));
    EXPECT_THAT(content_of(folder / "line.path"), HasSubstr("\n480,10,-1,8,cut,1\n"));
}

TEST(PlotCommand, UnitsHaveNames) {
    const ScratchFolder folder;
    write_content(folder / "line.plt", "IN;SP1;PU0,0;PD40000,0;PU;SP;");
    const auto width = [&](const std::string& unit) {
        const Ended ended = run({"plot", "info", (folder / "line.plt").string(), "--json", "--unit", unit});
        return ended.exit_code == 0 ? nlohmann::json::parse(ended.out).at("extents_mm")[2].get<double>()
                                    : -1.0;
    };
    EXPECT_DOUBLE_EQ(width("nominal"), 1000.0);
    EXPECT_NEAR(width("table"), 995.2, 1e-9);
    EXPECT_NEAR(width("0.0254"), 1016.0, 1e-9);
    EXPECT_NEAR(width("0.0254,0.03"), 1016.0, 1e-9);
    for (const char* none : {"inch", "1,", "1,0", "1,2,3", ",1", "1 2"}) {
        EXPECT_DOUBLE_EQ(width(none), -1.0) << none;
    }
    EXPECT_DOUBLE_EQ(width("-1"), -1.0);
}

TEST(PlotCommand, ViewIsAPictureInMillimetres) {
    const ScratchFolder folder;
    const std::string file = (folder / "view.svg").string();
    const auto view = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"plot", "view", sample, "--out", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Ended ended = run(arguments);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_EQ(ended.out, "39 strokes of 2 pens\n");
        return content_of(file);
    };
    EXPECT_THAT(view({}), HasSubstr("dasharray"));
    const std::string plain = view({"--no-air"});
    EXPECT_THAT(plain, HasSubstr("width=\"104.0000mm\" height=\"104.0000mm\"")); // 100 mm and the margins
    EXPECT_EQ(std::ranges::count(plain, 'M'), 39);
    EXPECT_THAT(view({"--no-air", "--unit", "0.025,0.05"}), HasSubstr("height=\"204.0000mm\""));
}

TEST(PlotCommand, FillsDashesAndLineEndsAreRead) {
    const ScratchFolder folder;
    const std::string file = (folder / "drawing.plt").string();
    write_content(folder / "drawing.plt", "IN;SP1;LT2,1;PU0,0;PD2000,0;LT;PU0,800;FT3,40,0;RA40\n00,1600;");
    const auto strokes = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"plot", "info", file, "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return nlohmann::json::parse(run(arguments).out).at("strokes").get<int>();
    };
    const int all = strokes({});
    EXPECT_GT(all, 21); // dashes, and lines of the fill
    EXPECT_EQ(strokes({"--fill", "none", "--solid"}), 1);
    EXPECT_EQ(strokes({"--fill", "outline", "--solid"}), 2);
    EXPECT_LT(strokes({"--line-ends", "separate"}), all); // three numbers are no corner
    EXPECT_EQ(strokes({"--line-ends", "join"}), all);
}

TEST(PlotCommand, StrictReadingEndsAtTheFirstFault) {
    const ScratchFolder folder;
    const std::string file = (folder / "bad.plt").string();
    write_content(folder / "bad.plt", "SP1;PU0,0;PD100,100;QX;");
    EXPECT_EQ(run({"plot", "info", file}).exit_code, 0);
    const Ended ended = run({"plot", "info", file, "--strict"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("byte 20: QX is not an HPGL command"));
}

TEST(PlotCommand, JunkIsNotDecoded) {
    const ScratchFolder folder;
    write_content(folder / "junk.plt", std::string(1000, '\xff'));
    const Ended ended = run({"plot",
                             "decode",
                             (folder / "junk.plt").string(),
                             "--velocity",
                             "40",
                             "--period",
                             "0.01",
                             "--out",
                             (folder / "points.csv").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("contains no HPGL command"));
    EXPECT_FALSE(std::filesystem::exists(folder / "points.csv"));
}

} // namespace
} // namespace millwright::test
