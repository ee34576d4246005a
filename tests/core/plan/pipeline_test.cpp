#include "core/plan/pipeline.h"

#include "core/base/error.h"
#include "core/plan/cut_study.h"
#include "core/project/project_file.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <thread>
#include <vector>

namespace millwright::plan {
namespace {

using project::GridMethod;
using test::sample_folders;
using test::small_sample;
using testing::HasSubstr;

/// A pipeline whose owner sleeps until it is woken, as the window does.
class PipelineTest : public testing::Test {
protected:
    std::atomic<int> woken{0};
    Pipeline pipeline{sample_folders, [this] { ++woken; }};

    /// Waits for a publication that `fits`, without any other clock than the test's time limit.
    template <class Fits> std::shared_ptr<const PublishedPlan> wait_for(Fits fits) const {
        while (true) {
            const auto plan = pipeline.latest();
            if (plan && fits(*plan)) {
                return plan;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
};

TEST_F(PipelineTest, EndsWithTheSameAsThePlanOfTheCommandLine) {
    const project::Project project = small_sample("dome", 7);
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    const Plan plan = make_plan(project, sample_folders, Progress());
    ASSERT_TRUE(published->exact);
    EXPECT_FALSE(published->failure);
    EXPECT_EQ(published->project, project);
    EXPECT_EQ(published->plan.listing->text, plan.listing->text);
    EXPECT_EQ(published->plan.grid(GridMethod::elliptic).evaluation->closest.mean,
              plan.grid(GridMethod::elliptic).evaluation->closest.mean);
    EXPECT_EQ(published->plan.singular_points.size(), plan.singular_points.size());
    EXPECT_GT(woken, 0);
    EXPECT_FALSE(pipeline.activity().busy);
}

TEST_F(PipelineTest, ShowsTheNewSurfaceBeforeTheFiguresAreExact) {
    project::Project project = small_sample("dome", 7);
    pipeline.request(project);
    pipeline.wait_idle();
    project.surface.patches[0].point(1, 1).z() += 5.0;
    pipeline.request(project);
    const auto first = wait_for([&](const PublishedPlan& plan) { return plan.project == project; });
    EXPECT_NE(first->plan.surface, nullptr);
    EXPECT_NE(first->plan.grid(GridMethod::tracks).evaluation, nullptr)
        << "the grid of before follows the drag";
    pipeline.wait_idle();
    EXPECT_TRUE(pipeline.latest()->exact);
}

TEST_F(PipelineTest, KeepsTheWholeChainOfTheSameSettingsOnly) {
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::chain;
    project.grid.chain.later_iterations = 10;
    pipeline.request(project);
    pipeline.wait_idle();
    const auto before = pipeline.latest();
    ASSERT_NE(before->plan.grid(GridMethod::chain).evaluation, nullptr);
    project.grid.method = GridMethod::tracks;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.grid(GridMethod::chain).evaluation,
              before->plan.grid(GridMethod::chain).evaluation)
        << "still there to compare";
    project.grid.method = GridMethod::chain;
    project.grid.chain.later_iterations = 0;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_NE(pipeline.latest()->plan.grid(GridMethod::chain).evaluation,
              before->plan.grid(GridMethod::chain).evaluation);
}

TEST_F(PipelineTest, KeepsWhatAChangeLeavesTrue) {
    project::Project project = small_sample("dome", 6);
    pipeline.request(project);
    pipeline.wait_idle();
    const auto before = pipeline.latest();
    project.program.feed_mm_per_min = 900.0;
    pipeline.request(project);
    pipeline.wait_idle();
    const auto feed = pipeline.latest();
    EXPECT_EQ(feed->plan.grid(GridMethod::tracks).evaluation,
              before->plan.grid(GridMethod::tracks).evaluation);
    EXPECT_EQ(feed->plan.grid(GridMethod::uniform).evaluation,
              before->plan.grid(GridMethod::uniform).evaluation);
    EXPECT_NE(feed->plan.program, before->plan.program);
    ASSERT_NE(before->plan.weight, nullptr);
    EXPECT_EQ(feed->plan.weight, before->plan.weight);
    project.grid.elliptic.adaptation = 50.0;
    pipeline.request(project);
    pipeline.wait_idle();
    const auto weight = pipeline.latest();
    EXPECT_EQ(weight->plan.grid(GridMethod::tracks).evaluation,
              before->plan.grid(GridMethod::tracks).evaluation);
    EXPECT_NE(weight->plan.grid(GridMethod::elliptic).evaluation,
              before->plan.grid(GridMethod::elliptic).evaluation);
    EXPECT_EQ(weight->plan.program, feed->plan.program);
    EXPECT_EQ(weight->plan.weight, before->plan.weight) << "LV does not change w";
    project.grid.elliptic.weight = project::WeightSource::w1;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_NE(pipeline.latest()->plan.weight->values, before->plan.weight->values);
}

TEST_F(PipelineTest, MakesWhatIsWantedOnly) {
    project::Project project = small_sample("dome", 6);
    pipeline.want(Scope{.cut = true});
    pipeline.request(project);
    pipeline.wait_idle();
    const auto alone = pipeline.latest();
    EXPECT_TRUE(alone->exact);
    EXPECT_NE(alone->plan.program, nullptr);
    EXPECT_EQ(alone->plan.grid(GridMethod::elliptic).evaluation, nullptr);
    pipeline.want(Scope::everything);
    pipeline.wait_idle();
    const auto all = pipeline.latest();
    EXPECT_TRUE(all->exact);
    EXPECT_EQ(all->plan.program, alone->plan.program) << "it was there";
    EXPECT_NE(all->plan.grid(GridMethod::elliptic).evaluation, nullptr);
    pipeline.want(Scope{.cut = true});
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->revision, all->revision) << "less is no work";
    project.surface.patches[0].point(1, 1).z() += 5.0;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_TRUE(pipeline.latest()->exact);
    EXPECT_EQ(pipeline.latest()->plan.grid(GridMethod::elliptic).evaluation, nullptr);
}

// What runs is not begun again, and what a person has cancelled does not come back by a look elsewhere.
TEST_F(PipelineTest, MoreIsMadeAfterWhatRunsAndNotAfterACancel) {
    const project::Project project = small_sample("two-bell", 40);
    pipeline.want(Scope{});
    pipeline.request(project);
    (void)wait_for([](const PublishedPlan& plan) { return plan.plan.program != nullptr; });
    pipeline.want(Scope{.times = true});
    const auto alone = wait_for([](const PublishedPlan& plan) { return plan.program_exact; });
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->plan.program, alone->plan.program);
    EXPECT_TRUE(pipeline.latest()->plan.grid(GridMethod::uniform).estimated_time);
    pipeline.request(small_sample("two-bell", 60));
    pipeline.cancel();
    pipeline.wait_idle();
    const auto revision = pipeline.latest()->revision;
    pipeline.want(Scope::everything);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->revision, revision);
}

TEST_F(PipelineTest, TheLastOfManyRequestsWins) {
    project::Project project = small_sample("sine", 6);
    for (int n = 0; n < 20; ++n) {
        project.surface.patches[0].point(2, 2).z() += 0.5;
        pipeline.request(project);
    }
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->project, project);
    EXPECT_TRUE(pipeline.latest()->exact);
}

TEST_F(PipelineTest, TheSameProjectIsNotDerivedTwice) {
    const project::Project project = small_sample("dome", 5);
    pipeline.request(project);
    pipeline.wait_idle();
    const auto revision = pipeline.latest()->revision;
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.latest()->revision, revision);
}

TEST_F(PipelineTest, ACancelledRequestCanBeMadeAgain) {
    const project::Project project = small_sample("two-bell", 60);
    pipeline.request(project);
    (void)wait_for([](const PublishedPlan&) { return true; });
    pipeline.cancel();
    pipeline.wait_idle();
    EXPECT_FALSE(pipeline.latest()->exact);
    pipeline.request(small_sample("two-bell", 5));
    pipeline.wait_idle();
    EXPECT_TRUE(pipeline.latest()->exact);
}

TEST(PipelineTold, WhatIsMeasuredCoarselyIsMarkedUntilTheExactOneIsThere) {
    std::mutex mutex;
    std::vector<grid::OptimiserStatus> uniform;
    Pipeline* told = nullptr;
    Pipeline pipeline(sample_folders, [&] {
        const std::scoped_lock lock(mutex);
        const auto plan = told->latest();
        if (plan && plan->plan.grid(GridMethod::uniform).evaluation) {
            uniform.push_back(plan->plan.grid(GridMethod::uniform).evaluation->outcome.status);
        }
    });
    told = &pipeline;
    pipeline.request(small_sample("dome", 6));
    pipeline.wait_idle();
    const std::scoped_lock lock(mutex);
    ASSERT_GE(uniform.size(), 2U);
    EXPECT_EQ(uniform.front(), grid::OptimiserStatus::running);
    EXPECT_EQ(uniform.back(), grid::OptimiserStatus::converged);
    const auto plan = pipeline.latest();
    ASSERT_TRUE(plan->exact);
    for (const GridMethod method : {GridMethod::elliptic, GridMethod::tracks}) { // that are compared
        EXPECT_NE(plan->plan.grid(method).evaluation->outcome.status, grid::OptimiserStatus::running);
    }
}

TEST_F(PipelineTest, AFaultIsPublishedWithWhatCouldBeMade) {
    project::Project project = small_sample("dome", 5);
    project.machine.workpiece_offset = Vec3(0, 0, 4000);
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    ASSERT_TRUE(published->failure);
    EXPECT_THAT(published->failure->message, HasSubstr("cannot be reached"));
    EXPECT_NE(published->plan.surface, nullptr);
    EXPECT_EQ(published->plan.program, nullptr);
    EXPECT_FALSE(published->exact);
    project.machine.workpiece_offset.reset();
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_TRUE(pipeline.latest()->exact);
}

TEST_F(PipelineTest, AFaultOfAGridThatIsOnlyComparedLeavesTheProgram) {
    project::Project project = small_sample("dome", 5);
    project.grid.method = GridMethod::tracks;
    project.grid.elliptic.weight = project::WeightSource::expression;
    project.grid.elliptic.expression = "1/(u-u)";
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    ASSERT_TRUE(published->failure);
    EXPECT_NE(published->plan.program, nullptr);
    EXPECT_EQ(published->plan.weight, nullptr);
    EXPECT_TRUE(published->plan.grid(GridMethod::elliptic).failure);
    EXPECT_EQ(published->plan.grid(GridMethod::elliptic).evaluation, nullptr);
    project.grid.method = GridMethod::uniform; // the other compared grid is made all the same
    pipeline.request(project);
    pipeline.wait_idle();
    EXPECT_NE(pipeline.latest()->plan.grid(GridMethod::tracks).evaluation, nullptr);
    EXPECT_TRUE(pipeline.latest()->plan.grid(GridMethod::elliptic).failure);
}

// What a comparison marks on another grid is what the cutter would do if that were the program's.
TEST_F(PipelineTest, TheCutterIsSweptAlongTheGridsBesideTheProgramToo) {
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::tracks;
    project.tool.cutter = toolpath::CutterKind::ball;
    project.tool.diameter_mm = 40.0;
    pipeline.request(project);
    pipeline.wait_idle();
    const auto published = pipeline.latest();
    ASSERT_TRUE(published->exact);
    const Plan& plan = published->plan;
    EXPECT_EQ(plan.cut_of(project, plan.grid(GridMethod::tracks).evaluation.get()), plan.cut);
    const auto beside = plan.cut_of(project, plan.grid(GridMethod::uniform).evaluation.get());
    ASSERT_NE(beside, nullptr);
    EXPECT_NE(plan.cut_of(project, plan.grid(GridMethod::elliptic).evaluation.get()), nullptr);
    project.grid.method = GridMethod::uniform;
    Plan uniform = make_plan(project, sample_folders, Progress(), Scope::program);
    add_cut_study(uniform, project, Progress());
    EXPECT_EQ(beside->deepest, uniform.cut->deepest);
    ASSERT_EQ(beside->bites.size(), uniform.cut->bites.size());
    EXPECT_GT(beside->bites.size(), 0U);
    for (std::size_t n = 0; n < beside->bites.size(); ++n) {
        EXPECT_EQ(beside->bites[n].bite.depth, uniform.cut->bites[n].bite.depth);
        EXPECT_EQ(beside->bites[n].line, 0);
    }
}

TEST_F(PipelineTest, AFaultyFieldStillShowsTheSurface) {
    project::Project project = small_sample("dome", 5);
    project.grid.nu = 1;
    pipeline.request(project);
    pipeline.wait_idle();
    ASSERT_TRUE(pipeline.latest()->failure);
    EXPECT_THAT(pipeline.latest()->failure->message, HasSubstr("grid/nu"));
    EXPECT_NE(pipeline.latest()->plan.surface, nullptr);
}

// T18.
TEST_F(PipelineTest, AnAdaptationIsSteppedPlayedAndReset) {
    pipeline.request(small_sample("dome", 8));
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.adaptation(), nullptr);
    pipeline.start_adaptation(GridMethod::tracks);
    EXPECT_EQ(pipeline.adaptation()->state, nullptr);
    EXPECT_FALSE(pipeline.adaptation()->playing);
    pipeline.step_adaptation();
    pipeline.step_adaptation();
    pipeline.wait_idle();
    const auto stepped = pipeline.adaptation();
    ASSERT_NE(stepped->state, nullptr);
    EXPECT_FALSE(stepped->playing);
    EXPECT_EQ(stepped->state->status, grid::OptimiserStatus::running);
    pipeline.play_adaptation();
    EXPECT_TRUE(pipeline.adaptation()->playing);
    pipeline.wait_idle();
    const auto played = pipeline.adaptation();
    EXPECT_FALSE(played->playing);
    EXPECT_NE(played->state->status, grid::OptimiserStatus::running);
    EXPECT_EQ(played->state->best, pipeline.latest()->plan.grid(GridMethod::tracks).evaluation->outcome.grid)
        << "the plan's own grid";
    EXPECT_GT(played->revision, stepped->revision);
    pipeline.reset_adaptation();
    EXPECT_EQ(pipeline.adaptation()->state, nullptr);
}

TEST_F(PipelineTest, APausedAdaptationGoesOnWhereItStood) {
    pipeline.request(small_sample("dome", 10));
    pipeline.wait_idle();
    pipeline.start_adaptation(GridMethod::tracks);
    pipeline.play_adaptation();
    pipeline.pause_adaptation();
    pipeline.wait_idle();
    EXPECT_FALSE(pipeline.adaptation()->playing);
    pipeline.play_adaptation();
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.adaptation()->state->best,
              pipeline.latest()->plan.grid(GridMethod::tracks).evaluation->outcome.grid);
}

TEST_F(PipelineTest, AnAdaptationEndsWhenItsGridIsNoLongerAskedFor) {
    project::Project project = small_sample("dome", 8);
    pipeline.request(project);
    pipeline.start_adaptation(GridMethod::tracks);
    pipeline.play_adaptation();
    project.program.feed_mm_per_min = 100.0;
    pipeline.request(project);
    EXPECT_NE(pipeline.adaptation(), nullptr);
    project.surface.patches[0].point(1, 1).x() += 1.0;
    pipeline.request(project);
    EXPECT_EQ(pipeline.adaptation(), nullptr);
    pipeline.step_adaptation();
    pipeline.wait_idle();
    EXPECT_EQ(pipeline.adaptation(), nullptr);
}

TEST_F(PipelineTest, AnAdaptationEndsWhenItsToolOrSequenceChanges) {
    const project::Project project = small_sample("dome", 8);
    const auto goes_on_after = [&](auto edit) {
        project::Project changed = project;
        edit(changed);
        pipeline.request(project);
        pipeline.start_adaptation(GridMethod::tracks);
        pipeline.request(changed);
        return pipeline.adaptation() != nullptr;
    };
    EXPECT_TRUE(goes_on_after([](project::Project& p) { p.tool.number = 7; }));
    EXPECT_FALSE(goes_on_after([](project::Project& p) { p.tool.lead_deg = 5.0; }));
    EXPECT_FALSE(goes_on_after([](project::Project& p) { p.tool.length_mm = 90.0; }));
    EXPECT_FALSE(
        goes_on_after([](project::Project& p) { p.sequencing.goal = toolpath::SequencingGoal::travel; }));
}

TEST_F(PipelineTest, WhatKeepsAnAdaptationFromStartingIsTold) {
    project::Project project = small_sample("dome", 8);
    project.machine.file = "none";
    pipeline.request(project);
    pipeline.start_adaptation(GridMethod::tracks);
    pipeline.step_adaptation();
    pipeline.wait_idle();
    ASSERT_TRUE(pipeline.adaptation()->failure);
    EXPECT_THAT(pipeline.adaptation()->failure->message, HasSubstr("unknown machine"));
}

TEST(PipelineEnd, AWorkingPipelineCanBeDestroyed) {
    for (int n = 0; n < 3; ++n) {
        Pipeline pipeline(sample_folders, [] {});
        pipeline.request(small_sample("two-bell", 40));
        pipeline.start_adaptation(GridMethod::tracks);
        pipeline.play_adaptation();
        std::this_thread::sleep_for(std::chrono::milliseconds(20 * n));
    }
}

} // namespace
} // namespace millwright::plan
