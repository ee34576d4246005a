#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace millwright::test {
namespace {

using testing::HasSubstr;

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
}

TEST(PlotCommand, ToolpathIsAProgramWithoutErrors) {
    const ScratchFolder folder;
    const std::string file = (folder / "plate.ngc").string();
    const Ended ended = run({"plot", "toolpath", sample, "--link", "3.0", "--order", "--out", file});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("linked: "));
    EXPECT_EQ(run({"gcode", "check", file}).exit_code, 0);
    EXPECT_EQ(run({"gcode", "time", file, "--machine", "router-xyz"}).exit_code, 0);
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
         {"X8.5000", "X111.5000", "Y8.5000", "Y111.5000", "Z-1.0000", "Z-2.0000", "F600.0000"}) {
        EXPECT_THAT(text, HasSubstr(word));
    }
    EXPECT_THAT(
        run({"plot", "toolpath", (folder / "square.plt").string(), "--level", "7:depth=2", "--out", file})
            .err,
        HasSubstr("pen 7 draws nothing"));
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
    // 40 mm of the square and 2.828 mm from and to the origin: 20 s, 0.28 s, and 6 s for the lift.
    EXPECT_THAT(runs({}), HasSubstr("0.043 m, 1 times down, 0:26 min by the thesis, "));
    EXPECT_THAT(runs({"--hatch", "1.5"}),
                HasSubstr(", 8 times down")); // the square, lines at 1.5, 3, ... 10.5
    EXPECT_THAT(runs({"--hatch", "1.5", "--hatch-cross"}), HasSubstr(", 15 times down"));
    EXPECT_THAT(runs({"--contours", "2"}), HasSubstr("times down"));
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
    EXPECT_THAT(at("100,0").err, HasSubstr("axis X would have to go to 500.000, outside 0.000 ... 480.000"));
    EXPECT_FALSE(std::filesystem::exists(file));
    EXPECT_THAT(at("0,-1").err, HasSubstr("axis Y would have to go to -1.000"));
    const Ended ended = at("80,10");
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(file), HasSubstr("X480.0000"));
    EXPECT_THAT(content_of(folder / "line.path"), HasSubstr("\n480,10,-1,10,cut,1\n"));
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
    EXPECT_THAT(ended.err, HasSubstr("byte 20: QX is no command of HPGL"));
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
    EXPECT_THAT(ended.err, HasSubstr("nothing to draw"));
    EXPECT_FALSE(std::filesystem::exists(folder / "points.csv"));
}

} // namespace
} // namespace millwright::test
