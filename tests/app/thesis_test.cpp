#include "tests/app/program.h"
#include "tests/app/shipped_files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

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
    EXPECT_THAT(as_blocks.err, HasSubstr("may be pairs: give its rows and columns"));
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

} // namespace
} // namespace millwright::test
