#include "core/plan/internal/derivation.h"

#include "core/plan/internal/grid_stages.h"
#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"
#include "tests/core/plan/sample_projects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace millwright::plan {
namespace {

using project::GridMethod;
using test::sample_folders;
using test::small_sample;
using testing::HasSubstr;

/// What was published, one after the other.
struct Shown {
    Plan plan;
    std::optional<Diagnostic> failure;
    bool program_exact;
    bool exact;
};

std::vector<Shown> derived(Derivation& derivation, const project::Project& project, const Scope& scope) {
    std::vector<Shown> shown;
    derivation.derive(project,
                      sample_folders,
                      scope,
                      [&](const Publication& now) {
                          shown.push_back({now.plan, now.failure, now.program_exact, now.exact});
                      },
                      {});
    return shown;
}

const std::shared_ptr<const Evaluation>& grid_of(const Shown& shown, GridMethod method) {
    return shown.plan.grid(method).evaluation;
}

TEST(Stages, ReadOnlyResultsOfStagesBeforeThem) {
    project::Project project = small_sample("dome", 6);
    for (const auto& method : project::grid_methods()) {
        for (const auto& strategy : project::strategies()) {
            project.grid.method = method.value;
            project.toolpath.strategy = strategy.value;
            std::vector<StageKey> before;
            for (const Stage& stage : stages_of(project, Scope::everything)) {
                for (const StageKey& key : stage.reads) {
                    EXPECT_EQ(std::ranges::count(before, key), 1)
                        << method.id << ", " << strategy.id << ", stage " << before.size();
                }
                EXPECT_EQ(std::ranges::count(before, stage.key), 0) << "made by one stage";
                EXPECT_EQ(stage.qualities.back(), Quality::exact);
                before.push_back(stage.key);
            }
        }
    }
}

TEST(Derivation, MakesTheProgramAloneWhereNothingElseIsAskedFor) {
    Derivation derivation;
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::tracks;
    const Shown last = derived(derivation, project, Scope{}).back();
    EXPECT_TRUE(last.exact);
    EXPECT_TRUE(last.program_exact);
    EXPECT_NE(last.plan.program, nullptr);
    EXPECT_NE(grid_of(last, GridMethod::tracks), nullptr);
    EXPECT_EQ(grid_of(last, GridMethod::elliptic), nullptr);
    EXPECT_FALSE(last.plan.grid(GridMethod::uniform).estimated_time);
    EXPECT_EQ(last.plan.weight, nullptr);
}

TEST(Derivation, MakesWhatIsAskedForLaterBesideWhatIsThere) {
    Derivation derivation;
    const project::Project project = small_sample("dome", 6);
    const Shown alone = derived(derivation, project, Scope{.times = true, .cut = true}).back();
    const std::vector<Shown> shown = derived(derivation, project, Scope::everything);
    EXPECT_FALSE(shown.front().exact) << "there will be more";
    EXPECT_TRUE(shown.front().program_exact) << "of the program there will not";
    const Shown& all = shown.back();
    EXPECT_TRUE(all.exact);
    EXPECT_EQ(all.plan.program, alone.plan.program);
    EXPECT_EQ(grid_of(all, GridMethod::uniform), grid_of(alone, GridMethod::uniform));
    EXPECT_EQ(all.plan.grid(GridMethod::uniform).estimated_time,
              alone.plan.grid(GridMethod::uniform).estimated_time);
    EXPECT_NE(grid_of(all, GridMethod::elliptic), nullptr);
    EXPECT_NE(all.plan.weight, nullptr);
}

TEST(Derivation, KeepsWhatHoldsThoughItIsNotAskedForAnyMore) {
    Derivation derivation;
    project::Project project = small_sample("dome", 6);
    const Shown all = derived(derivation, project, Scope::everything).back();
    project.program.feed_mm_per_min += 100.0;
    const Shown feed = derived(derivation, project, Scope{}).back();
    EXPECT_EQ(grid_of(feed, GridMethod::elliptic), grid_of(all, GridMethod::elliptic));
    EXPECT_EQ(feed.plan.weight, all.plan.weight);
    EXPECT_FALSE(feed.plan.grid(GridMethod::elliptic).estimated_time) << "of the old feed";
    project.grid.elliptic.adaptation += 1.0;
    const Shown adaptation = derived(derivation, project, Scope{}).back();
    EXPECT_EQ(grid_of(adaptation, GridMethod::elliptic), nullptr);
    EXPECT_EQ(adaptation.plan.program, feed.plan.program);
    EXPECT_TRUE(adaptation.exact);
}

TEST(Derivation, ATimeOfTheProgramsGridIsThatOfItsProgram) {
    Derivation derivation;
    project::Project project = small_sample("dome", 6);
    project.grid.method = GridMethod::tracks;
    (void)derived(derivation, project, Scope::everything);
    project.grid.method = GridMethod::elliptic;
    const Shown other = derived(derivation, project, Scope::everything).back();
    EXPECT_EQ(other.plan.grid(GridMethod::elliptic).estimated_time, other.plan.trajectory->duration());
    EXPECT_TRUE(other.plan.grid(GridMethod::tracks).estimated_time);
    project.toolpath.strategy = project::StrategyInput::spiral;
    const Shown spiral = derived(derivation, project, Scope::everything).back();
    EXPECT_EQ(spiral.plan.path_time, spiral.plan.trajectory->duration());
    EXPECT_NE(spiral.plan.grid(GridMethod::elliptic).estimated_time, spiral.plan.path_time);
    project.toolpath.strategy = project::StrategyInput::zigzag;
    const Shown zigzag = derived(derivation, project, Scope::everything).back();
    EXPECT_EQ(zigzag.plan.path, nullptr);
    EXPECT_FALSE(zigzag.plan.path_time);
    EXPECT_EQ(zigzag.plan.grid(GridMethod::elliptic).estimated_time, other.plan.trajectory->duration());
}

TEST(Derivation, AFaultLeavesTheSurfaceAloneAndGoesWithItsCause) {
    Derivation derivation;
    project::Project project = small_sample("dome", 6);
    const Shown good = derived(derivation, project, Scope::everything).back();
    project.program.feed_mm_per_min = -1.0;
    const std::vector<Shown> faulty = derived(derivation, project, Scope::everything);
    ASSERT_TRUE(faulty.back().failure);
    EXPECT_THAT(faulty.back().failure->message, HasSubstr("feed"));
    EXPECT_EQ(faulty.back().plan.surface, good.plan.surface);
    EXPECT_EQ(faulty.back().plan.program, nullptr);
    EXPECT_EQ(grid_of(faulty.back(), GridMethod::uniform), nullptr);
    EXPECT_FALSE(faulty.back().program_exact);
    project.program.feed_mm_per_min = 600.0;
    EXPECT_TRUE(derived(derivation, project, Scope::everything).back().exact);
}

/// While a comparison fails the program is no less than it is.
TEST(Derivation, TheProgramIsExactThoughAComparedGridHasFailed) {
    Derivation derivation;
    project::Project project = small_sample("dome", 5);
    project.grid.method = GridMethod::tracks;
    project.grid.elliptic.weight = project::WeightSource::expression;
    project.grid.elliptic.expression = "1/(u-u)";
    const Shown last = derived(derivation, project, Scope::everything).back();
    ASSERT_TRUE(last.failure);
    EXPECT_TRUE(last.program_exact);
    EXPECT_FALSE(last.exact);
}

TEST(Stages, WhyAComparisonWithNearestAnglesIsMissingIsKept) {
    project::Project project = small_sample("dome", 6);
    project.sequencing.goal = toolpath::SequencingGoal::travel;
    Plan plan = make_plan(project, sample_folders, {}, Scope::program);
    ASSERT_NE(plan.unsequenced, nullptr);
    EXPECT_FALSE(plan.unsequenced_failure);
    CuttingSetup far_away = *plan.cutting_setup; // out of reach
    far_away.machine = far_away.machine.with_workpiece_offset(Vec3(0, 0, 4000));
    plan.cutting_setup = std::make_shared<const CuttingSetup>(std::move(far_away));
    const std::vector<Stage> stages = stages_of(project, Scope::program);
    const auto stage = std::ranges::find(stages, StageKey{StageKind::unsequenced}, &Stage::key);
    ASSERT_NE(stage, stages.end());
    EXPECT_TRUE(stage->make({plan, source_of(project, sample_folders), {}, Quality::exact, {}}));
    EXPECT_EQ(plan.unsequenced, nullptr);
    EXPECT_FALSE(plan.unsequenced_time);
    ASSERT_TRUE(plan.unsequenced_failure);
    EXPECT_THAT(plan.unsequenced_failure->message, HasSubstr("cannot be reached"));
    EXPECT_NE(plan.program, nullptr);
    stage->clear(plan);
    EXPECT_FALSE(plan.unsequenced_failure);
}

/// The stages of plans, of which one fails in a coarse result.
Derivation::Stages failing_coarsely(StageKey key) {
    return [key](const project::Project& project, const Scope& scope) {
        std::vector<Stage> stages = stages_of(project, scope);
        const auto stage = std::ranges::find(stages, key, &Stage::key);
        stage->make = [make = stage->make](const StageWork& work) {
            if (work.quality != Quality::exact) {
                throw Error("a coarse grid leaves the travel");
            }
            return make(work);
        };
        return stages;
    };
}

// Else the window would show a fault of a project of which the command line makes a program.
TEST(Derivation, AFaultOfACoarseResultLeavesTheExactOneToBeTried) {
    project::Project project = small_sample("dome", 6);
    project.toolpath.strategy = project::StrategyInput::spiral;
    const Plan alone = Derivation().finish(project, sample_folders, Scope::everything, {});
    for (const StageKey& key : {StageKey{StageKind::program},
                                StageKey{StageKind::path},
                                grid_key(GridMethod::uniform),
                                grid_key(program_grid(project))}) {
        Derivation derivation(failing_coarsely(key));
        for (const Shown& shown : derived(derivation, project, Scope::everything)) {
            EXPECT_FALSE(shown.failure);
        }
        const Shown last = derived(derivation, project, Scope::everything).back();
        EXPECT_TRUE(last.exact);
        ASSERT_NE(last.plan.listing, nullptr);
        EXPECT_EQ(last.plan.listing->text, alone.listing->text);
    }
    Derivation derivation(failing_coarsely({StageKind::cutting_setup})); // it is what it will be
    EXPECT_TRUE(derived(derivation, project, Scope::everything).back().failure);
}

TEST(Derivation, EndsWithTheSameAsTheExactResultsAlone) {
    const project::Project project = small_sample("two-bell", 6);
    Derivation coarse_first;
    const Shown last = derived(coarse_first, project, Scope::everything).back();
    const Plan alone = Derivation().finish(project, sample_folders, Scope::everything, {});
    EXPECT_EQ(last.plan.listing->text, alone.listing->text);
    for (const GridMethod method : project::every_grid_method) {
        const auto &a = last.plan.grid(method), &b = alone.grid(method);
        ASSERT_EQ(a.evaluation == nullptr, b.evaluation == nullptr);
        EXPECT_EQ(a.estimated_time, b.estimated_time);
        if (a.evaluation) {
            EXPECT_EQ(a.evaluation->closest.mean, b.evaluation->closest.mean);
        }
    }
}

} // namespace
} // namespace millwright::plan
