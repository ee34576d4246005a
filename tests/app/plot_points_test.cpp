// Point files of a table on the command line: decoded, looked at, cut, played elsewhere.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;

TEST(PointFiles, PointsThatWereDecodedAreLookedAtAndCut) {
    const ScratchFolder folder;
    const std::string points = (folder / "points.csv").string();
    const Ended made = run({"plot",
                            "decode",
                            "assets/samples/plot/figures.plt",
                            "--velocity",
                            "40",
                            "--period",
                            "0.02",
                            "--pen-up",
                            "2",
                            "--out",
                            points});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const Ended told = run({"plot", "info", points, "--json"});
    ASSERT_EQ(told.exit_code, 0) << told.err;
    const auto of_points = nlohmann::json::parse(told.out);
    const auto of_plot =
        nlohmann::json::parse(run({"plot", "info", "assets/samples/plot/figures.plt", "--json"}).out);
    EXPECT_THAT(made.out, HasSubstr(std::to_string(of_points.at("points").get<int>()) + " points"));
    EXPECT_EQ(of_points.at("z_mm"), nlohmann::json({0.0, 2.0}));
    EXPECT_EQ(of_points.at("lifts"), of_plot.at("lifts"));
    const double drawn = of_plot.at("draw_mm");
    EXPECT_NEAR(of_points.at("draw_mm").get<double>(), drawn, 0.01 * drawn);
    EXPECT_THAT(run({"plot", "info", points}).out, HasSubstr("points of a table"));
    const std::string svg = (folder / "points.svg").string();
    const Ended seen = run({"plot", "view", points, "--out", svg});
    EXPECT_EQ(seen.exit_code, 0) << seen.err;
    EXPECT_THAT(content_of(svg), HasSubstr("<svg"));
    const std::string program = (folder / "points.ngc").string();
    const Ended cut = run({"plot", "toolpath", points, "--machine", "router-xyz", "--out", program});
    EXPECT_EQ(cut.exit_code, 0) << cut.err;
    EXPECT_EQ(run({"gcode", "check", program}).exit_code, 0);
    EXPECT_THAT(run({"plot", "decode", points, "--velocity", "1", "--period", "1", "--out", svg}).err,
                HasSubstr("these are already points of a table"));
    const Ended shaped = run({"plot", "toolpath", points, "--depth", "3", "--out", program});
    EXPECT_EQ(shaped.exit_code, 2);
    EXPECT_THAT(shaped.err, HasSubstr("--depth applies only to plots and programs"));
}

TEST(PointFiles, PointsLieWhereTheirOriginIs) {
    const ScratchFolder folder;
    const std::string here = (folder / "here.csv").string();
    const std::string there = (folder / "there.csv").string();
    const auto decoded = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> words{"plot",
                                       "decode",
                                       "assets/samples/plot/figures.plt",
                                       "--velocity",
                                       "40",
                                       "--period",
                                       "0.02",
                                       "--out",
                                       out};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    };
    ASSERT_EQ(decoded(here, {}).exit_code, 0);
    ASSERT_EQ(decoded(there, {"--origin", "30,40"}).exit_code, 0);
    EXPECT_THAT(content_of(here), testing::StartsWith("0.00,0.00,"));
    EXPECT_THAT(content_of(there), testing::StartsWith("30.00,40.00,"));
    write_content(folder / "line.csv", "0,0,5\n0.1,0,5\n0.2,0,5\n");
    const Ended played = run({"plot",
                              "play",
                              (folder / "line.csv").string(),
                              "--period",
                              "0.04",
                              "--origin",
                              "30,40",
                              "--log",
                              (folder / "jobs").string()});
    EXPECT_EQ(played.exit_code, 0) << played.err;
    EXPECT_THAT(played.out, HasSubstr("3 of 3 points"));
    EXPECT_THAT(played.out, HasSubstr("at X 30.200 Y 40.000"));
    EXPECT_THAT(
        run({"plot", "play", (folder / "line.csv").string(), "--period", "0.04", "--origin", "-5,0"}).err,
        HasSubstr("axis X would move to -5.000"));
}

} // namespace
} // namespace millwright::test
