#include "tests/app/scratch_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;
using Corner = std::array<double, 3>;

class FinishCommand : public ScratchFiles {
protected:
    [[nodiscard]] Ended finish(const std::string& mesh, std::vector<std::string> more) const {
        std::vector<std::string> arguments{
            "finish", mesh, "--machine", "router-xyz", "--out", path("out"), "--spindle", "10000"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    [[nodiscard]] nlohmann::json report() const {
        return nlohmann::json::parse(content_of(path("out/finish.json")));
    }
};

class StlText {
public:
    void add(const Corner& a, const Corner& b, const Corner& c) {
        text_ += "facet normal 0 0 0\nouter loop\n";
        for (const Corner& corner : {a, b, c}) {
            text_ += fmt::format("vertex {} {} {}\n", corner[0], corner[1], corner[2]);
        }
        text_ += "endloop\nendfacet\n";
    }
    void add(const Corner& a, const Corner& b, const Corner& c, const Corner& d) {
        add(a, b, c);
        add(a, c, d);
    }
    [[nodiscard]] std::string text() const { return "solid made\n" + text_ + "endsolid made\n"; }

private:
    std::string text_;
};

/// Waves with a valley line, over 10 x 7 mm, below Z 0.
std::string relief() {
    const auto at = [](int i, int j) {
        const double x = 0.5 * i;
        const double y = 0.5 * j;
        return Corner{
            20.0 + x, 20.0 + y, -6.0 + 2.0 * std::sin(0.6 * x) * std::cos(0.5 * y) + std::abs(y - 3.3) / 4};
    };
    StlText stl;
    for (int j = 0; j < 14; ++j) {
        for (int i = 0; i < 20; ++i) {
            stl.add(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
        }
    }
    return stl.text();
}

/// A block of 80 x 60 x 30 mm with a pocket of 60 x 40 x 20 mm in its middle, its top at Z 0.
std::string pocket() {
    const std::array<std::array<double, 2>, 4> outer{{{0, 0}, {80, 0}, {80, 60}, {0, 60}}};
    const std::array<std::array<double, 2>, 4> inner{{{10, 10}, {70, 10}, {70, 50}, {10, 50}}};
    const auto at = [](const std::array<double, 2>& p, double z) { return Corner{p[0], p[1], z}; };
    StlText stl;
    stl.add(at(outer[3], -30), at(outer[2], -30), at(outer[1], -30), at(outer[0], -30));
    stl.add(at(inner[0], -20), at(inner[1], -20), at(inner[2], -20), at(inner[3], -20));
    for (std::size_t k = 0; k < 4; ++k) {
        const auto& a = outer[k];
        const auto& b = outer[(k + 1) % 4];
        const auto& c = inner[k];
        const auto& d = inner[(k + 1) % 4];
        stl.add(at(a, -30), at(b, -30), at(b, 0), at(a, 0));
        stl.add(at(d, -20), at(c, -20), at(c, 0), at(d, 0));
        stl.add(at(a, 0), at(b, 0), at(d, 0), at(c, 0));
    }
    return stl.text();
}

TEST_F(FinishCommand, LeavesNoMoreThanItsScallopWhereTheToolFits) {
    const Ended ended = finish(written("relief.stl", relief()),
                               {"--tool", "ball:2", "--scallop", "0.015", "--tolerance", "0.004"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto check = report().at("check");
    EXPECT_LE(check.at("largest_left").at("distance_mm").get<double>(), 0.02);
    EXPECT_GT(check.at("largest_left").at("distance_mm").get<double>(), 0.001);
    EXPECT_LE(check.at("deepest_gouge").at("depth_mm").get<double>(), 0.006);
    EXPECT_GT(check.at("fits_percent").get<double>(), 50.0);
    EXPECT_DOUBLE_EQ(check.at("within_percent").get<double>(), 100.0);
    EXPECT_THAT(ended.out, HasSubstr("largest distance left where it fits: 0.0"));
    EXPECT_THAT(ended.err, HasSubstr("68 open edges (the mesh has a border), the first at"));
    EXPECT_THAT(content_of(path("out/program.ngc")), HasSubstr("finish: relief.stl"));
    EXPECT_THAT(content_of(path("out/left.ply")), StartsWith("ply\n"));
}

TEST_F(FinishCommand, FinishesAPocketWithAFlatEndAndNamesTheCornerThatItMissed) {
    const Ended ended = finish(written("pocket.stl", pocket()), {"--tool", "flat:8:l40", "--step-over", "2"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, Not(HasSubstr("open edge")));
    const auto check = report().at("check");
    EXPECT_LE(check.at("deepest_gouge").at("depth_mm").get<double>(), 0.006);
    const auto place = check.at("largest_left").at("position_mm");
    const double from_middle_x = std::abs(place.at(0).get<double>() - 40.0);
    const double from_middle_y = std::abs(place.at(1).get<double>() - 30.0);
    EXPECT_GT(from_middle_x, 30.0 - 4.0);
    EXPECT_GT(from_middle_y, 20.0 - 4.0);
}

TEST_F(FinishCommand, AToolEightMillimetresInTheWallIsSaidToBeEightDeep) {
    const std::string program = written("wall.ngc",
                                        "G21 G90\nM3 S5000\nG0 Z5\nG0 X30 Y30\nG1 Z-20 F600\n"
                                        "G1 X70 Y30\nG1 X30 Y30\nG0 Z5\nM2\n");
    const Ended ended = run({"simulate",
                             program,
                             "--machine",
                             "router-xyz",
                             "--stock",
                             "box:80,60,30@0,0,-30",
                             "--tool",
                             "flat:16",
                             "--part",
                             written("pocket.stl", pocket()),
                             "--out",
                             path("cut")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("8.000 mm deep"));
    const auto found = nlohmann::json::parse(content_of(path("cut/simulation.json")));
    EXPECT_NEAR(found.at("comparison").at("largest_gouge").at("deviation_mm").get<double>(), -8.0, 0.01);
}

TEST_F(FinishCommand, RefusesATooShortToolUnderAHolder) {
    const std::string tool = written(
        "short.json",
        R"({"format": "millwright-tool", "version": 1, "tool": {"cutter": "ball", "diameter_mm": 4.0,)"
        R"( "length_mm": 15.0, "holder_diameter_mm": 30.0, "holder_length_mm": 40.0}})");
    const Ended ended = finish(written("pocket.stl", pocket()), {"--tool", tool, "--step-over", "3"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("the holder meets the mesh"));
    EXPECT_THAT(ended.err, HasSubstr("20.000 mm are needed"));
}

TEST_F(FinishCommand, TravelsAboveTheMaterialThatIsNamed) {
    const std::string mesh = written("relief.stl", relief());
    const auto ended_with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> options{"--tool", "ball:2", "--step-over", "1", "--one-way"};
        options.insert(options.end(), more.begin(), more.end());
        const Ended ended = finish(mesh, options);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return ended;
    };
    const Ended known = ended_with({"--allowance", "3"});
    EXPECT_THAT(known.err, Not(HasSubstr("not known")));
    EXPECT_DOUBLE_EQ(report().at("path").at("allowance_mm").get<double>(), 3.0);
    EXPECT_EQ(report().at("check").at("rapid_moves_in_material"), 0);
    const Ended unknown = ended_with({});
    EXPECT_THAT(unknown.err, HasSubstr("material above the mesh is not known"));
    EXPECT_TRUE(report().at("path").at("allowance_mm").is_null());
    EXPECT_THAT(report().at("mesh").at("remarks").dump(), HasSubstr("material above the mesh is not known"));
}

TEST_F(FinishCommand, SaysWhereTheGaugeLengthIsFrom) {
    const Ended ended = run({"finish",
                             written("pocket.stl", pocket()),
                             "--machine",
                             "ca-head",
                             "--tool",
                             "ball:6",
                             "--step-over",
                             "5",
                             "--out",
                             path("out")});
    EXPECT_THAT(ended.err, HasSubstr("gauge length is taken from the machine file"));
}

TEST_F(FinishCommand, LeavesNoProgramOfAnotherPostBesideItsReport) {
    const std::string mesh = written("relief.stl", relief());
    std::filesystem::create_directory(path("out"));
    const std::string older = written("out/program.h", "0 BEGIN PGM OLD MM\n");
    const Ended ended = finish(mesh, {"--tool", "ball:2", "--step-over", "1"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_FALSE(std::filesystem::exists(older));
    EXPECT_TRUE(std::filesystem::exists(path("out/program.ngc")));
    const std::string input = written("out/program.nc", relief()); // a mesh under the name of a program
    const Ended kept = finish(input, {"--tool", "ball:2", "--step-over", "1"});
    EXPECT_EQ(kept.exit_code, 1);
    EXPECT_THAT(kept.err, HasSubstr("is an input file"));
    EXPECT_EQ(content_of(input), relief());
}

TEST_F(FinishCommand, RefusesWhatCannotBeFinished) {
    const std::string mesh = written("relief.stl", relief());
    EXPECT_THAT(finish(mesh, {"--tool", "flat:4"}).err,
                HasSubstr("give the distance of the passes with --step-over"));
    EXPECT_THAT(finish(mesh, {"--tool", "v:60:6", "--step-over", "1"}).err, HasSubstr("a sharp point"));
    EXPECT_THAT(finish(mesh, {"--tool", "ball:2", "--axis", "0,0,0"}).err, HasSubstr("is no direction"));
    EXPECT_THAT(finish(mesh, {"--tool", "ball:2", "--axis", "0,1,1"}).err,
                HasSubstr("it has no rotary axes"));
    EXPECT_THAT(finish(mesh, {"--tool", "ball:2", "--unit", "m"}).err, HasSubstr("are too many"));
    EXPECT_THAT(finish(mesh, {"--tool", "ball:2", "--shift", "1e6,0,0"}).err,
                HasSubstr("farther than 100000 mm"));
    EXPECT_THAT(finish(written("empty.stl", ""), {"--tool", "ball:2"}).err, HasSubstr("the file is empty"));
    const Ended outside = finish(mesh, {"--tool", "ball:2", "--step-over", "2", "--shift", "0,0,500"});
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_THAT(outside.err, HasSubstr("axis Z"));
}

} // namespace
} // namespace millwright::test
