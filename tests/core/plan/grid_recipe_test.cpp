// The worked example of docs/dev/recipes.md, "Add a grid method": all that a new method is but its line in
// core/project/grid_methods/grid_method.h.
#include "core/base/units.h"
#include "core/plan/plan.h"
#include "core/project/grid_methods/grid_method_row.h"
#include "tests/core/plan/sample_projects.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <string_view>

namespace millwright::plan {
namespace {

/// Nodes closer together at the ends of each track along v, in one step: v - 0.5 sin(2 pi v) / (2 pi).
class EndSpacing : public grid::GridOptimiser {
public:
    EndSpacing(const grid::ErrorModel& model, const grid::Grid& start, grid::TrackDirection direction)
        : model_(model), direction_(direction),
          state_{.current = start.array(), .best = start, .start = {}, .now = {}, .of_best = {}, .note = {}} {
    }

    bool advance(const Progress& progress) override {
        if (state_.status != grid::OptimiserStatus::running) {
            return false;
        }
        for (Vec2& node : state_.current.nodes) {
            node.y() = std::clamp(node.y() - 0.5 * std::sin(2.0 * pi * node.y()) / (2.0 * pi), 0.0, 1.0);
        }
        const grid::Grid found(state_.current);
        state_.reached = state_.current;
        state_.start = model_.on_path(state_.best, direction_, progress);
        state_.now = model_.on_path(found, direction_, progress);
        const bool better = state_.now.mean < state_.start.mean;
        state_.best = better ? found : state_.best;
        state_.of_best = better ? state_.now : state_.start;
        state_.status = better ? grid::OptimiserStatus::converged : grid::OptimiserStatus::no_gain;
        state_.note = better ? "Nodes closer together at the ends" : "Even steps have less error";
        state_.done = 1.0;
        return false;
    }
    [[nodiscard]] const grid::OptimiserState& state() const override { return state_; }

private:
    const grid::ErrorModel& model_;
    grid::TrackDirection direction_;
    grid::OptimiserState state_;
};

} // namespace
} // namespace millwright::plan

namespace millwright::project {

extern const GridMethodRow end_spacing_row; // in grid_method.h

constinit const GridMethodRow end_spacing_row{
    .id = "end-spacing",
    .label = "End spacing",
    .tip = "Nodes closer together at the ends of the tracks",
    .report_key = "end_spacing",
    .short_name = "Ends",
    .caption = "denser at the ends",
    .title = "Moving the nodes to the ends",
    .share = 0.02,
    .same_settings = [](const GridInput&, const GridInput&) { return true; },
    .optimiser = [](GridStart from) -> std::unique_ptr<grid::GridOptimiser> {
        expect_straight_tracks(from.input.direction, from.start);
        return std::make_unique<plan::EndSpacing>(from.error, from.start, from.input.direction);
    }};

} // namespace millwright::project

namespace millwright::plan {
namespace {

constexpr project::GridMethod end_spacing{&project::end_spacing_row};

TEST(GridRecipe, ARowMakesAGridThatIsMeasuredLikeTheOthers) {
    const project::Project project = test::small_sample("dome", 9);
    const CuttingSetup cutting_setup = cutting_setup_of(project, test::sample_folders);
    const toolpath::KinematicError error = cutting_setup.error_model();
    const auto optimiser = make_optimiser(end_spacing, project.grid, error);
    const Evaluation found =
        evaluate(cutting_setup, improved_outcome(*optimiser, {}), report_sampling, Progress());
    EXPECT_EQ(found.outcome.grid.nu(), 9);
    const grid::OptimiserState& state = optimiser->state();
    EXPECT_LT(state.reached.at(3, 1).y(), 1.0 / 8.0) << "nearer to the end than an even step";
    EXPECT_EQ(state.best.array() == state.reached, state.now.mean < state.start.mean);
}

TEST(GridRecipe, ItsRowIsAllThatItIsKnownBy) {
    EXPECT_EQ(row_of(end_spacing).label, "End spacing");
    EXPECT_FALSE(end_spacing == project::GridMethod::redistribution);
    EXPECT_FALSE(uses_weight(end_spacing));
    EXPECT_EQ(memory_sentence(end_spacing, {}), "");
    EXPECT_EQ(index_of(end_spacing), project::every_grid_method.size()) << "it is not in the list";
}

TEST(GridMethodRows, AreCompleteAndDifferFromEachOther) {
    std::set<std::string_view> names;
    for (const project::GridMethod method : project::every_grid_method) {
        const project::GridMethodRow& row = row_of(method);
        EXPECT_EQ(project::every_grid_method.at(index_of(method)), method);
        for (const std::string_view text :
             {row.id, row.label, row.tip, row.report_key, row.short_name, row.caption, row.title}) {
            EXPECT_FALSE(text.empty()) << row.id;
        }
        EXPECT_TRUE(names.insert(row.id).second) << row.id;
        EXPECT_GT(row.share, 0.0);
        EXPECT_TRUE(row.same_settings({}, {}));
        EXPECT_EQ(row.optimiser == nullptr, method == project::GridMethod::uniform);
        EXPECT_EQ(row.memory == nullptr, row.grid_name.empty());
    }
}

// A setting that a row forgets would leave a stale grid on the screen.
TEST(GridMethodRows, ComparedSettingsAreTheMethodsOwn) {
    const project::GridInput before;
    project::GridInput tracks = before, elliptic = before, solver = before, chain = before, floor = before;
    tracks.tracks.polish_sweeps += 1;
    elliptic.elliptic.tolerance *= 2.0;
    solver.elliptic.adaptation *= 2.0;
    chain.chain.first_iterations += 1;
    floor.redistribution.floor *= 2.0;
    const auto same = [&](project::GridMethod method, const project::GridInput& after) {
        return row_of(method).same_settings(before, after);
    };
    using project::GridMethod;
    EXPECT_FALSE(same(GridMethod::tracks, tracks));
    EXPECT_FALSE(same(GridMethod::chain, tracks)) << "it begins with them";
    EXPECT_TRUE(same(GridMethod::tracks, chain));
    EXPECT_FALSE(same(GridMethod::chain, chain));
    EXPECT_FALSE(same(GridMethod::elliptic, elliptic));
    EXPECT_FALSE(same(GridMethod::harmonic, elliptic));
    EXPECT_FALSE(same(GridMethod::elliptic, solver));
    EXPECT_TRUE(same(GridMethod::harmonic, solver)) << "it has no LV";
    EXPECT_FALSE(same(GridMethod::redistribution, floor));
    EXPECT_TRUE(same(GridMethod::uniform, elliptic));
}

} // namespace
} // namespace millwright::plan
