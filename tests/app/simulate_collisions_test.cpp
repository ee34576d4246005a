// Collisions of `millwright simulate`: shank lengths, exact faces, and what is said beside them.
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// Along a plate 60 x 40 x 10 with its top at Z 0.
constexpr const char* pass_program = "G21 G90 G17\n"
                                     "T1 M6\n"
                                     "M3 S8000\n"
                                     "G0 Z5\n"
                                     "G0 X-10 Y20\n"
                                     "G0 Z-2\n"
                                     "G1 X70 F300\n"
                                     "G0 Z5\n"
                                     "M2\n";

Ended pass(const ScratchFolder& scratch, const std::vector<std::string>& more) {
    std::ofstream(scratch / "pass.ngc") << pass_program;
    std::vector<std::string> arguments{"simulate",
                                       (scratch / "pass.ngc").string(),
                                       "--machine",
                                       "router-xyz",
                                       "--resolution",
                                       "0.5",
                                       "--out",
                                       (scratch / "out").string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
}

/// A wall across the pass, between two heights.
fs::path wall(const ScratchFolder& scratch, int low, int high) {
    const fs::path file = scratch / "wall.stl";
    std::ofstream out(file);
    out << "solid wall\n";
    for (const char* triangle :
         {"023", "031", "457", "476", "015", "054", "267", "273", "046", "062", "137", "175"}) {
        out << "facet normal 0 0 0\nouter loop\n";
        for (int k = 0; k < 3; ++k) {
            const int n = triangle[k] - '0';
            out << "vertex " << ((n & 1) != 0 ? 50 : 40) << ' ' << ((n & 2) != 0 ? 30 : 10) << ' '
                << ((n & 4) != 0 ? high : low) << '\n';
        }
        out << "endloop\nendfacet\n";
    }
    out << "endsolid wall\n";
    return file;
}

TEST(SimulateCollisions, AFluteLengthOfANumberWinsOverTheOneOfAllTools) {
    const ScratchFolder scratch;
    const std::string fixture = wall(scratch, 28, 40).string();
    const std::vector<std::vector<std::string>> orders{{"20", "1=10"}, {"1=10", "20"}};
    for (const auto& order : orders) {
        const Ended ended = pass(scratch,
                                 {"--stock",
                                  "box:60,40,10",
                                  "--tool",
                                  "1=flat:6:l50",
                                  "--fixture",
                                  fixture,
                                  "--flutes",
                                  order[0],
                                  "--flutes",
                                  order[1]});
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr("pass.ngc:7: shank collides with fixture wall.stl")) << order[0];
        EXPECT_THAT(ended.err, Not(HasSubstr("cutter collides"))) << order[0];
    }
    // The shank of a tool with a number of its own begins where that number says.
    const std::vector<std::vector<std::string>> lengths{{"1", "1=20"}, {"1=20", "1"}};
    for (const auto& order : lengths) {
        const Ended ended = pass(scratch,
                                 {"--stock",
                                  "box:60,40,10",
                                  "--tool",
                                  "1=flat:6:l50",
                                  "--flutes",
                                  order[0],
                                  "--flutes",
                                  order[1]});
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
    }
}

TEST(SimulateCollisions, TwoFluteLengthsOfOneToolAreRefused) {
    const ScratchFolder scratch;
    const auto with = [&](const std::string& one, const std::string& other) {
        const Ended ended =
            pass(scratch,
                 {"--stock", "box:60,40,10", "--tool", "1=flat:6:l50", "--flutes", one, "--flutes", other});
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_FALSE(fs::exists(scratch / "out"));
        return ended.err;
    };
    EXPECT_THAT(with("1=20", "1=10"), HasSubstr("tool 1 has two flute lengths, 20 mm and 10 mm"));
    EXPECT_THAT(with("20", "10"), HasSubstr("all tools have two flute lengths, 20 mm and 10 mm"));
}

TEST(SimulateCollisions, AShankInTheStockIsNotCalledAProgramThatMeetsNone) {
    const ScratchFolder scratch;
    // The cutter passes below the stock.
    const std::vector<std::string> tool{"--tool", "flat:6:l50", "--flutes", "1"};
    const auto with = [&](const std::string& stock) {
        std::vector<std::string> arguments{"--stock", stock};
        arguments.insert(arguments.end(), tool.begin(), tool.end());
        return pass(scratch, arguments);
    };
    const Ended in_shank = with("box:60,40,3@0,0,0");
    EXPECT_EQ(in_shank.exit_code, 1);
    EXPECT_THAT(in_shank.err, HasSubstr("shank collides with stock"));
    EXPECT_THAT(in_shank.err, Not(HasSubstr("no move meets the stock")));
    const Ended beside = with("box:60,40,3@0,100,0");
    EXPECT_THAT(beside.err, HasSubstr("no move meets the stock"));
}

/// The STEP file of a bicubic patch with one more knot in u, 0.5: the same surface, in two spans.
std::string with_a_knot(std::string step) {
    const auto id_behind = [&](std::size_t at) { return std::stoi(step.substr(step.find('#', at) + 1)); };
    const std::size_t surface = step.find("B_SPLINE_SURFACE_WITH_KNOTS('',3,3,(");
    const std::size_t rows = step.find('(', step.find("3,3,(", surface) + 5);
    const std::size_t end = step.find(")),.UNSPECIFIED.", rows);
    const int first = id_behind(rows); // sixteen points follow each other
    std::string net, points;
    int next = 9001;
    for (int row = 0; row < 5; ++row) {
        net += row == 0 ? "(" : ",(";
        for (int column = 0; column < 4; ++column) {
            std::array<double, 3> sum{};
            for (const int near : {std::max(row - 1, 0), std::min(row, 3)}) {
                const std::string mark = fmt::format("#{} = CARTESIAN_POINT('',(", first + 4 * near + column);
                const std::size_t at = step.find(mark);
                std::istringstream numbers(step.substr(at + mark.size(), 200));
                char comma = 0;
                for (double& coordinate : sum) {
                    double number = 0.0;
                    numbers >> number >> comma;
                    coordinate += 0.5 * number;
                }
            }
            points +=
                fmt::format("#{} = CARTESIAN_POINT('',({:#},{:#},{:#}));\n", next, sum[0], sum[1], sum[2]);
            net += fmt::format("{}#{}", column == 0 ? "" : ",", next++);
        }
        net += row == 4 ? "" : ")";
    }
    const std::string knots = "(4,4),(4,4),(0.,1.),(0.,1.)";
    step.replace(step.find(knots, end), knots.size(), "(4,1,4),(4,4),(0.,0.5,1.),(0.,1.)");
    step.replace(rows, end - rows, net);
    step.insert(step.rfind("ENDSEC;"), points);
    return step;
}

TEST(SimulateCollisions, AnExactFaceIsThePartThatTheHolderMayNotTouch) {
    const ScratchFolder scratch;
    const auto path = [&](const char* name) { return (scratch / name).string(); };
    const Ended made =
        run({"export", small_project(scratch.path(), "dome").string(), "--out", path("dome.step")});
    if (made.exit_code != 0) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    std::ofstream(scratch / "spans.step") << with_a_knot(content_of(scratch / "dome.step"));
    std::ofstream(scratch / "short.json")
        << R"({"format": "millwright-tool", "version": 1, "tool": {"cutter": "ball", "diameter_mm": 6,
               "length_mm": 3, "holder_diameter_mm": 60, "holder_length_mm": 40}})";
    const auto collisions_of = [&](const char* cad_file) {
        const Ended imported = run({"import", path(cad_file), "--exact", "--out", path("face.json")});
        EXPECT_EQ(imported.exit_code, 0) << imported.err;
        const Ended ended = run({"simulate",
                                 path("face.json"),
                                 "--tool",
                                 path("short.json"),
                                 "--resolution",
                                 "4",
                                 "--out",
                                 path("out")});
        EXPECT_EQ(ended.exit_code, 1) << ended.err;
        return nlohmann::json::parse(content_of(scratch / "out/simulation.json")).at("collisions");
    };
    const auto deepest_of_holder = [](const nlohmann::json& collisions) {
        double deepest = 0.0;
        for (const auto& contact : collisions.at("contacts")) {
            if (contact.at("bodies")[0] == "holder" && contact.at("bodies")[1] == "part") {
                deepest = std::max(deepest, contact.at("depth_mm").get<double>());
            }
        }
        return deepest;
    };
    const nlohmann::json face = collisions_of("spans.step");
    EXPECT_TRUE(nlohmann::json::parse(content_of(scratch / "face.json")).at("surface").contains("face"));
    EXPECT_THAT(face.at("bodies").get<std::vector<std::string>>(), Contains("part"));
    const double of_face = deepest_of_holder(face);
    EXPECT_GT(of_face, 0.5);
    EXPECT_NEAR(of_face, deepest_of_holder(collisions_of("dome.step")), 0.1 * of_face);
}

} // namespace
} // namespace millwright::test
