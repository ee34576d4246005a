#include "tests/app/program.h"
#include "tests/app/shipped_files.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// T11: The same records as tests/core/toolpath/thesis_files_test.cpp has from an independent program.
TEST(ThesisCommand, WritesTheFilesOfTheListing) {
    const ScratchFolder scratch;
    const Ended ended = run({"thesis", "files", dome_project, "--out", scratch / "out"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(scratch / "out/Surface.dat"), StartsWith("64 382 72 377\n72 377 80 373\n"));
    const std::string path = content_of(scratch / "out/Toolpath.dat");
    EXPECT_EQ(std::ranges::count(path, '\n'), 2 * (20 * 20 - 1));
    ASSERT_EQ(
        run({"thesis", "files", dome_project, "--out", scratch / "faulty", "--listing-faults"}).exit_code, 0);
    EXPECT_NE(content_of(scratch / "faulty/Toolpath.dat"), path);
    ASSERT_EQ(
        run({"thesis", "files", dome_project, "--out", scratch / "gui", "--constants", "gui"}).exit_code, 0);
    EXPECT_NE(content_of(scratch / "gui/Toolpath.dat"), path);
    EXPECT_EQ(run({"thesis", "files", dome_project, "--out", scratch / "x", "--constants", "own"}).exit_code,
              2);
}

TEST(ThesisCommand, RefusesASurfaceThatTheListingsViewCannotShow) {
    const ScratchFolder scratch;
    auto json = nlohmann::json::parse(content_of(small_project(scratch.path(), "dome")));
    for (auto& row : json["surface"]["patches"][0]["points"]) {
        for (auto& point : row) {
            point[0] = point[0].get<double>() - 1000.0;
        }
    }
    write_content(scratch / "away.json", json.dump());
    const Ended ended = run({"thesis", "files", scratch / "away.json", "--out", scratch / "out"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("no scale for this surface"));
}

TEST(ThesisCommand, AGridGoesThroughBothForms) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    const Ended ended = run({"thesis", "grid", project, "--out", scratch / "grid.dat"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("6 x 6 nodes"));
    ASSERT_EQ(
        run({"thesis", "convert", scratch / "grid.dat", "--out", scratch / "pairs.dat", "--to", "pairs"})
            .exit_code,
        0);
    ASSERT_EQ(
        run({"thesis", "convert", scratch / "pairs.dat", "--size", "6,6", "--out", scratch / "again.dat"})
            .exit_code,
        0);
    EXPECT_EQ(content_of(scratch / "again.dat"), content_of(scratch / "grid.dat"));
    const Ended wrong =
        run({"thesis", "convert", scratch / "pairs.dat", "--size", "6,7", "--out", scratch / "no.dat"});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, HasSubstr("pairs.dat"));
    const Ended as_blocks = run({"thesis", "convert", scratch / "pairs.dat", "--out", scratch / "no.dat"});
    EXPECT_EQ(as_blocks.exit_code, 1);
    EXPECT_THAT(as_blocks.err, HasSubstr("specify rows and columns if this is a file of pairs"));
}

TEST(ThesisCommand, ReadsResidualsWhichNeedNoCells) {
    const ScratchFolder scratch;
    write_content(scratch / "r.dat", "1 -1 \n 0.5 2\n3 3 \n 3 3\n");
    EXPECT_EQ(run({"thesis", "convert", scratch / "r.dat", "--out", scratch / "o.dat"}).exit_code, 1);
    const Ended ended = run(
        {"thesis", "convert", scratch / "r.dat", "--residuals", "--to", "pairs", "--out", scratch / "o.dat"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("2 x 2 residuals"));
}

/// The thesis's test: 25 x 25 nodes, W1, its iteration, one round, nodes of the boundary held.
std::filesystem::path thesis_case(const ScratchFolder& scratch, double lv, int iterations) {
    auto json = nlohmann::json::parse(content_of(dome_project));
    json["grid"]["nu"] = json["grid"]["nv"] = 25;
    auto& elliptic = json["grid"]["elliptic"];
    elliptic["weight"] = "w1";
    elliptic["solver"] = "reference";
    elliptic["adaptation"] = lv;
    elliptic["max_iterations"] = iterations;
    elliptic["max_rounds"] = 1;
    elliptic["sliding_boundary"] = false;
    write_content(scratch / "case.json", json.dump());
    return scratch / "case.json";
}

std::string figure_behind(const std::string& text, const std::string& words) {
    const auto at = text.find(words);
    return at == std::string::npos
               ? std::string()
               : text.substr(at + words.size(), text.find(' ', at + words.size()) - at - words.size());
}

// T13, T19: figures of an independent implementation; the grid is written though it does not improve the
// path.
TEST(ThesisCommand, WritesTheAdaptedGridWithItsResidualsAndNorms) {
    const ScratchFolder scratch;
    const Ended ended = run({"thesis",
                             "grid",
                             thesis_case(scratch, 1.0, 250),
                             "--method",
                             "elliptic",
                             "--units",
                             "nodes",
                             "--form",
                             "pairs",
                             "--out",
                             scratch / "grid.dat",
                             "--residuals",
                             scratch / "orx.dat",
                             "--norms",
                             scratch / "norms.csv"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("25 x 25 nodes, x from 0 to 24, y from 0 to 24"));
    EXPECT_THAT(ended.out, HasSubstr("250 iterations in 1 round, norm 5.26083"));
    EXPECT_THAT(ended.out, HasSubstr("Smallest cell area 0.800441"));
    const std::string norms = content_of(scratch / "norms.csv");
    EXPECT_THAT(norms, StartsWith("iteration,round,lv,norm\n1,1,1,4.04592246"));
    EXPECT_EQ(std::ranges::count(norms, '\n'), 251);
    const std::string residuals = content_of(scratch / "orx.dat");
    EXPECT_EQ(std::ranges::count(residuals, '\n'), 50);
    EXPECT_EQ(run({"thesis", "convert", scratch / "orx.dat", "--residuals", "--out", scratch / "again.dat"})
                  .exit_code,
              0);
    EXPECT_THAT(ended.err,
                HasSubstr("warning: The solver did not converge: round 1 ended after 250 iterations"));
    // What is printed is of the grid that is written, whatever the method keeps.
    EXPECT_THAT(ended.out, testing::ContainsRegex("The method keeps (the start|another) grid: "));
    const std::string this_grid = figure_behind(ended.out, "this grid ");
    EXPECT_NE(this_grid, figure_behind(ended.out, "curve: start "));
    const Ended again = run({"thesis",
                             "grid",
                             scratch / "case.json",
                             "--method",
                             "elliptic",
                             "--units",
                             "nodes",
                             "--start",
                             scratch / "grid.dat",
                             "--out",
                             scratch / "next.dat"});
    ASSERT_EQ(again.exit_code, 0) << again.err;
    EXPECT_EQ(figure_behind(again.out, "curve: start "), this_grid);
    // Not the uniform grid, which the program keeps.
    ASSERT_EQ(run({"thesis",
                   "grid",
                   scratch / "case.json",
                   "--method",
                   "uniform",
                   "--units",
                   "nodes",
                   "--form",
                   "pairs",
                   "--out",
                   scratch / "uniform.dat"})
                  .exit_code,
              0);
    EXPECT_NE(content_of(scratch / "grid.dat"), content_of(scratch / "uniform.dat"));
}

/// The displaced grid of the thesis's smoothing test, as pairs x, y.
std::string displaced_pairs() {
    std::string text;
    const double turn = 8.0 * std::atan(1.0) / 24.0;
    for (int i = 0; i < 25; ++i) {
        for (int j = 0; j < 25; ++j) {
            const double wave = 1.2 * std::sin(turn * j);
            const double x = i + wave * std::sin(turn * i), y = j + wave * std::sin(0.5 * turn * i);
            const bool edge = i == 0 || j == 0 || i == 24 || j == 24;
            text += fmt::format("{:.12f} {:.12f}\n", edge ? i : x, edge ? j : y);
        }
    }
    return text;
}

// T13: 982 iterations smooth it.
TEST(ThesisCommand, SmoothsADisplacedStartGrid) {
    const ScratchFolder scratch;
    const auto project = thesis_case(scratch, 0.0, 5000);
    write_content(scratch / "source", displaced_pairs());
    const std::vector<std::string> words{"thesis",
                                         "grid",
                                         project,
                                         "--method",
                                         "elliptic",
                                         "--units",
                                         "nodes",
                                         "--start",
                                         scratch / "source",
                                         "--out",
                                         scratch / "smooth.dat",
                                         "--norms",
                                         scratch / "norms.csv"};
    const Ended ended = run(words);
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("982 iterations in 1 round, norm 9.98641"));
    EXPECT_THAT(content_of(scratch / "norms.csv"), HasSubstr("\n1,1,0,1.50633122"));
}

// It was "a cell is folded", without a word about what to do.
TEST(ThesisCommand, ATransposedStartGridGetsAHint) {
    const ScratchFolder scratch;
    const auto project = thesis_case(scratch, 0.0, 10);
    const auto says = [&](bool indices, bool coordinates) {
        std::string text;
        for (int i = 0; i < 25; ++i) {
            for (int j = 0; j < 25; ++j) { // bent, so that u and v differ
                const double a = (indices ? j : i) / 24.0, b = (indices ? i : j) / 24.0;
                const double u = a, v = b * b;
                text += coordinates ? fmt::format("{} {}\n", v, u) : fmt::format("{} {}\n", u, v);
            }
        }
        write_content(scratch / "source", text);
        return run({"thesis",
                    "grid",
                    project,
                    "--method",
                    "elliptic",
                    "--start",
                    scratch / "source",
                    "--out",
                    scratch / "o.dat"});
    };
    EXPECT_EQ(says(false, false).exit_code, 0);
    for (const bool indices : {false, true}) {
        const Ended ended = says(indices, !indices);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr("source:"));
        EXPECT_THAT(ended.err, HasSubstr("rows and columns, or x and y, are exchanged"));
    }
}

TEST(ThesisCommand, RefusesAStartGridThatIsNone) {
    const ScratchFolder scratch;
    const auto project = thesis_case(scratch, 0.0, 10);
    const auto with_start = [&](const std::string& units) {
        return run({"thesis",
                    "grid",
                    project,
                    "--method",
                    "elliptic",
                    "--units",
                    units,
                    "--start",
                    scratch / "source",
                    "--out",
                    scratch / "o.dat"});
    };
    write_content(scratch / "source", displaced_pairs());
    const Ended outside = with_start("parameters");
    EXPECT_EQ(outside.exit_code, 1);
    EXPECT_THAT(outside.err,
                HasSubstr("source:3:16: y of node (0, 2) is 2, outside the surface, which goes from 0 to 1"));
    const Ended bent = run({"thesis",
                            "grid",
                            project,
                            "--method",
                            "tracks",
                            "--units",
                            "nodes",
                            "--start",
                            scratch / "source",
                            "--out",
                            scratch / "o.dat"});
    EXPECT_EQ(bent.exit_code, 1);
    EXPECT_THAT(bent.err, HasSubstr("track 1 of the start grid, counted from 0, is not straight"));
    write_content(scratch / "source", "0 0\n1 1\n");
    EXPECT_EQ(with_start("nodes").exit_code, 1);
    const Ended no_method =
        run({"thesis", "grid", project, "--start", scratch / "source", "--out", scratch / "o.dat"});
    EXPECT_EQ(no_method.exit_code, 2);
    const Ended none = run({"thesis",
                            "grid",
                            project,
                            "--method",
                            "tracks",
                            "--residuals",
                            scratch / "r.dat",
                            "--out",
                            scratch / "o.dat"});
    EXPECT_EQ(none.exit_code, 2);
    EXPECT_THAT(none.err, HasSubstr("--residuals applies only to --method elliptic"));
}

TEST(ThesisCommand, WritesTheGridOfEveryMethod) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    for (const char* method : {"uniform", "redistribution", "elliptic", "harmonic", "tracks", "chain"}) {
        const auto file = scratch / (std::string(method) + ".dat");
        const Ended ended = run({"thesis", "grid", project, "--method", method, "--out", file});
        ASSERT_EQ(ended.exit_code, 0) << method << ended.err;
        EXPECT_EQ(std::ranges::count(content_of(file), '\n'), 12) << method;
    }
}

// It wrote the start grid, which is not the uniform one.
TEST(ThesisCommand, TheUniformGridTakesNoStart) {
    const ScratchFolder scratch;
    const auto project = small_project(scratch.path(), "dome");
    const std::vector<std::string> words{"thesis", "grid", project, "--out", scratch / "o.dat", "--method"};
    const auto by = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        return run(more);
    };
    EXPECT_EQ(by({"tracks"}).exit_code, 0);
    std::filesystem::rename(scratch / "o.dat", scratch / "tracks.dat");
    const Ended refused = by({"uniform", "--start", scratch / "tracks.dat"});
    EXPECT_EQ(refused.exit_code, 2);
    EXPECT_THAT(refused.err, HasSubstr("--start does not apply to --method uniform"));
    EXPECT_FALSE(std::filesystem::exists(scratch / "o.dat"));
    EXPECT_EQ(by({"chain", "--start", scratch / "tracks.dat"}).exit_code, 0) << "blocks are read back";
}

TEST(ThesisCommand, WritesTheFilesOfTheProjectsOwnMachineAndDirection) {
    const ScratchFolder scratch;
    const auto path = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"thesis", "files", scratch / "dome.json", "--out", scratch / "out"};
        words.insert(words.end(), more.begin(), more.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return content_of(scratch / "out/Toolpath.dat");
    };
    auto json = nlohmann::json::parse(content_of(dome_project));
    json["grid"]["nu"] = 7;
    json["grid"]["nv"] = 5;
    const auto written = [&] { write_content(scratch / "dome.json", json.dump()); };
    written();
    const std::string own = path({});
    EXPECT_EQ(std::ranges::count(own, '\n'), 2 * (7 * 5 - 1));
    EXPECT_EQ(path({"--constants", "listing"}), own) << "the dome is on the listing's machine";
    EXPECT_EQ(path({"--direction", "along-v", "--nodes", "7,5"}), own);
    for (const char* list : {"5,", ",5", "5,,7"}) {
        const Ended holed =
            run({"thesis", "files", scratch / "dome.json", "--out", scratch / "out", "--nodes", list});
        EXPECT_EQ(holed.exit_code, 2) << list;
        EXPECT_THAT(holed.err, HasSubstr("has an empty entry")) << list;
    }
    EXPECT_NE(path({"--direction", "along-u"}), own);
    json["machine"]["workpiece_offset"] = {-15.0, 0.0, 100.0};
    written();
    EXPECT_NE(path({}), own) << "another position of the part";
    json["machine"]["file"] = "ac-table";
    written();
    EXPECT_NE(path({}), own) << "another machine";
    EXPECT_EQ(run({"thesis", "files", scratch / "dome.json", "--out", scratch / "out", "--listing-faults"})
                  .exit_code,
              2);
    EXPECT_EQ(path({"--constants", "listing"}), own);
}

TEST(ThesisCommand, WritesOverNoFileThatIsRead) {
    const ScratchFolder folder;
    const std::string project = folder / "own.json";
    write_content(project, content_of(dome_project));
    const auto grid = [&](const std::string& option, const std::string& file) {
        return run(
            {"thesis", "grid", project, "--method", "elliptic", "--out", folder / "grid.dat", option, file});
    };
    for (const char* option : {"--norms", "--residuals"}) {
        const Ended ended = grid(option, project);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err,
                    HasSubstr(std::string(option) + " would overwrite PROJECT, which is an input file"));
    }
    EXPECT_EQ(content_of(project), content_of(dome_project));
    EXPECT_THAT(grid("--norms", folder / "grid.dat").err, HasSubstr("name the same file"));
}

} // namespace
} // namespace millwright::test
