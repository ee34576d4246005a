#include "core/project/plot_work.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::shared_ptr<const PlotResult> derived(const PlotInput& input) {
    PlotWorker worker("assets", [] {});
    worker.request(input);
    worker.wait_idle();
    return worker.latest();
}

const fs::path everyday = "assets/samples/plot/everyday.plt";

TEST(PlotWork, LevelsThatAreNotSetAreLikeTheUsualOne) {
    PlotInput input{"assets/samples/plot/hatched-sign.plt", {}}; // of two pens
    input.settings.level.depth = 2.5;
    const auto usual = derived(input);
    ASSERT_FALSE(usual->failure);
    ASSERT_GE(usual->levels.size(), 2U);
    EXPECT_DOUBLE_EQ(usual->levels[1].depth, 2.5);
    input.settings.levels = {usual->levels[0]};
    input.settings.levels[0].depth = 0.5;
    const auto set = derived(input);
    EXPECT_DOUBLE_EQ(set->levels[0].depth, 0.5);
    EXPECT_DOUBLE_EQ(set->levels[1].depth, 2.5);
}

TEST(PlotWork, TheOriginMovesEverythingThatIsCut) {
    PlotInput input{everyday, {}};
    const auto here = derived(input);
    input.settings.origin = {30.0, 40.0};
    const auto there = derived(input);
    ASSERT_EQ(here->path->size(), there->path->size());
    for (std::size_t n = 0; n < here->path->size(); ++n) {
        EXPECT_LT(((*there->path)[n].at - (*here->path)[n].at - Vec3(30.0, 40.0, 0.0)).norm(), 1e-9);
    }
    const Vec3 drawn = there->cuts.front().path.chunks.front()->points.front().position();
    const Vec3 before = here->cuts.front().path.chunks.front()->points.front().position();
    EXPECT_LT((drawn - before - Vec3(30.0, 40.0, 0.0)).norm(), 1e-4); // kept as floats
    EXPECT_LT(((*there->strokes)[0].points[0] - (*here->strokes)[0].points[0] - Vec2(30.0, 40.0)).norm(),
              1e-9);
}

TEST(PlotWork, TheProgramIsThatOfThePathAndGoesWithItsWorker) {
    fs::path program;
    {
        PlotWorker worker("assets", [] {});
        worker.request({everyday, {}});
        worker.wait_idle();
        program = worker.latest()->program;
        EXPECT_EQ(read_file(program), plot_program_text(*worker.latest(), "assets"));
    }
    EXPECT_FALSE(fs::exists(program));
}

/// Of so many points, back and forth over 100 mm.
void write_zigzag(const fs::path& file, std::size_t points) {
    std::ofstream out(file);
    out << "IN;SP1;PU0,0;PD";
    for (std::size_t n = 0; n < points; ++n) {
        out << (n > 0 ? "," : "") << n % 4000 << "," << 40 + n % 7 * 40;
    }
    out << ";PU0,0;SP;";
}

TEST(PlotWork, TheProgramOfALongPathIsWrittenWhereItIsAskedFor) {
    const test::ScratchFolder scratch;
    write_zigzag(scratch / "long.plt", most_points_at_once);
    PlotWorker worker("assets", [] {});
    worker.request({scratch / "long.plt", {}});
    worker.wait_idle();
    ASSERT_FALSE(worker.latest()->failure);
    EXPECT_TRUE(worker.latest()->finished);
    EXPECT_GT(worker.latest()->path->size(), most_points_at_once);
    EXPECT_TRUE(worker.latest()->program.empty());
    const auto revision = worker.latest()->revision;

    worker.request_program();
    worker.wait_idle();
    ASSERT_FALSE(worker.latest()->program.empty());
    EXPECT_GT(worker.latest()->revision, revision);
    EXPECT_EQ(read_file(worker.latest()->program), plot_program_text(*worker.latest(), "assets"));

    worker.request_program(); // it is there
    worker.wait_idle();
    EXPECT_EQ(worker.latest()->revision, revision + 1);
}

TEST(PlotWork, TheProgramOfALongPathIsNotWrittenForAPathThatIsGone) {
    const test::ScratchFolder scratch;
    write_zigzag(scratch / "long.plt", most_points_at_once);
    PlotWorker worker("assets", [] {});
    worker.request({scratch / "long.plt", {}});
    worker.wait_idle();
    worker.request_program();
    worker.request({everyday, {}}); // in its place
    worker.wait_idle();
    ASSERT_FALSE(worker.latest()->failure);
    EXPECT_EQ(worker.latest()->input.file, everyday);
    EXPECT_EQ(read_file(worker.latest()->program), plot_program_text(*worker.latest(), "assets"));
}

TEST(PlotWork, WhatCannotBeFollowedIsANotice) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "pages.plt") << "IN;PC1;SP1;PU0,0;PD400,0;PG;";
    const auto made = derived({scratch / "pages.plt", {}});
    ASSERT_FALSE(made->failure);
    ASSERT_EQ(made->notices.size(), 2U);
    EXPECT_THAT(to_text(made->notices[0]), HasSubstr("1 PC left out"));
}

TEST(PlotWork, WhatCannotBeCutIsAFailureWithItsReason) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "empty.plt") << "IN;SP1;PU0,0;";
    EXPECT_THAT(to_text(*derived({scratch / "empty.plt", {}})->failure), HasSubstr("nothing to cut"));
    EXPECT_THAT(to_text(*derived({scratch / "gone.plt", {}})->failure), HasSubstr("gone.plt"));
    PlotInput thin{everyday, {}};
    thin.settings.plate = 0.5;
    EXPECT_TRUE(derived(thin)->failure);
    PlotInput nowhere{everyday, {}};
    nowhere.settings.machine = "no-such-machine";
    const auto made = derived(nowhere);
    EXPECT_THAT(to_text(*made->failure), HasSubstr("no-such-machine"));
    EXPECT_TRUE(made->path); // what there is stays to be looked at
    EXPECT_TRUE(made->program.empty());
}

} // namespace
} // namespace millwright::project
