// Grids are made for the nearest branches of the rotary axes; what they are worth is measured along the way
// that a project asks for.
#include "core/base/units.h"
#include "core/geometry/presets.h"
#include "core/plan/grids.h"
#include "tests/support/machines.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace millwright::plan {
namespace {

using project::GridMethod;
using toolpath::SequencingGoal;

struct Made {
    Evaluation uniform;
    Evaluation found;
};

/// Tracks along u on the two bells, on a table where the two branches turn unlike each other.
Made tracks_on_two_bells(int nu, int nv, SequencingGoal goal) {
    project::GridInput input;
    input.nu = nu;
    input.nv = nv;
    input.direction = grid::TrackDirection::along_u;
    CuttingSetup cutting_setup{geometry::surface_preset("two-bell").make().patch(geometry::PatchId{0}),
                               test::machine("tilted-c-table"),
                               input.direction};
    cutting_setup.sequencing.goal = goal;
    const Evaluation uniform = evaluate(cutting_setup, uniform_outcome(input), report_sampling, {});
    return {uniform, improved_evaluation({GridMethod::tracks, input, cutting_setup}, uniform, {})};
}

void expect_a_third_less(const Made& made) {
    EXPECT_LT(made.found.closest.max, 2.0 / 3.0 * made.uniform.closest.max);
    EXPECT_LT(made.found.closest.mean, 2.0 / 3.0 * made.uniform.closest.mean);
    EXPECT_LE(made.found.closest.axis_max, made.uniform.closest.axis_max);
}

// The way of least travel over the optimised tracks turns the axis by 30.4 degrees, over the uniform grid by
// 29.9: all of the gain was given up. That of least error turns it by 15.6.
TEST(GridEvaluation, TracksAreRunAlongTheirOwnBranchesWhereLeastTravelWouldGiveUpTheirGain) {
    const Made made = tracks_on_two_bells(20, 20, SequencingGoal::travel);
    expect_a_third_less(made);
    EXPECT_THAT(made.found.outcome.note, testing::HasSubstr("it follows the branches with the least error."));
}

// The fastest way over these nodes takes a branch that errs by 10.8 mm; along the nearest ones it is 2.6 mm.
TEST(GridEvaluation, TracksAreRunAlongTheNearestBranchesWhereTheFastestWayWouldGiveUpTheirGain) {
    const Made made = tracks_on_two_bells(12, 8, SequencingGoal::time);
    expect_a_third_less(made);
    EXPECT_THAT(made.found.outcome.note, testing::HasSubstr("it follows the nearest branches."));
}

TEST(GridEvaluation, TheGoalIsFollowedWhereItCostsNoGain) {
    const Made made = tracks_on_two_bells(12, 8, SequencingGoal::error);
    expect_a_third_less(made);
    EXPECT_THAT(made.found.outcome.note, testing::Not(testing::HasSubstr("it follows")));
}

TEST(GridEvaluation, WhatTheChainDidStaysToldWhereAnotherGridIsTaken) {
    project::GridInput input;
    input.nu = 12;
    input.nv = 8;
    input.direction = grid::TrackDirection::along_u;
    const CuttingSetup cutting_setup{geometry::surface_preset("saddle").make().patch(geometry::PatchId{0}),
                                     test::machine("bc-table-head"),
                                     input.direction};
    const Evaluation uniform = evaluate(cutting_setup, uniform_outcome(input), report_sampling, {});
    const Evaluation found = improved_evaluation({GridMethod::chain, input, cutting_setup}, uniform, {});
    EXPECT_THAT(found.outcome.note, testing::HasSubstr("On the finished part no stage of the chain"));
    ASSERT_FALSE(found.outcome.stages.empty());
    EXPECT_EQ(found.outcome.stages.front().name, "start");
}

/// The dome on a table with a head, 20 x 20 nodes along v, with a largest turn of a rotary axis.
Made tracks_on_the_dome(double largest_step_deg) {
    project::GridInput input;
    CuttingSetup cutting_setup{geometry::surface_preset("dome").make().patch(geometry::PatchId{0}),
                               test::machine("bc-table-head"),
                               input.direction};
    cutting_setup.sequencing.largest_step = from_degrees(largest_step_deg);
    const Evaluation uniform = evaluate(cutting_setup, uniform_outcome(input), report_sampling, {});
    return {uniform, improved_evaluation({GridMethod::tracks, input, cutting_setup}, uniform, {})};
}

// With points at every 30 degrees the uniform grid turns the axis less than the tracks do; its tip errs by
// 3.5 mm. The tracks were given up for it.
TEST(GridEvaluation, AddedPointsMakeNoTracksWorse) {
    const Made without = tracks_on_the_dome(0.0);
    for (const double step : {30.0, 5.0}) {
        const Made made = tracks_on_the_dome(step);
        EXPECT_EQ(made.found.outcome.grid, without.found.outcome.grid);
        EXPECT_GT(made.uniform.toolpath.points.size(), without.uniform.toolpath.points.size());
        EXPECT_LE(made.found.closest.max, without.found.closest.max * (1.0 + 1e-9));
        EXPECT_LE(made.found.closest.mean, without.found.closest.mean * (1.0 + 1e-9));
        const bool added = made.found.toolpath.points.size() > without.found.toolpath.points.size();
        EXPECT_EQ(added, step < 10.0) << "the tracks need none at 30 degrees";
        EXPECT_EQ(added, made.found.outcome.note.find("that the sequencing added.") != std::string::npos);
    }
}

/// What was made, or the refusal; a Defect is neither.
std::string made_or_refused(GridMethod method, const project::GridInput& input) {
    const CuttingSetup cutting_setup{geometry::surface_preset("dome").make().patch(geometry::PatchId{0}),
                                     test::machine("rotary-tilt-listing"),
                                     input.direction};
    const Evaluation uniform = evaluate(cutting_setup, uniform_outcome(input), report_sampling, {});
    try {
        (void)improved_evaluation({method, input, cutting_setup}, uniform, {});
        return "made";
    } catch (const Error& refusal) {
        return refusal.diagnostic().message;
    }
}

TEST(GridEvaluation, TwoNodesAlongASideAreEnoughOrRefused) {
    for (const auto& [nu, nv] : {std::pair(2, 2), std::pair(2, 5), std::pair(5, 2)}) {
        project::GridInput input;
        input.nu = nu;
        input.nv = nv;
        input.elliptic.max_iterations = 20;
        input.elliptic.max_rounds = 1;
        for (const GridMethod method : project::every_grid_method) {
            if (method != GridMethod::uniform) {
                EXPECT_EQ(made_or_refused(method, input), "made") << nu << " x " << nv;
            }
        }
        for (const auto solver : {grid::EllipticMethod::reference, grid::EllipticMethod::multigrid}) {
            input.elliptic.solver = solver;
            EXPECT_THAT(made_or_refused(GridMethod::elliptic, input),
                        testing::EndsWith(
                            fmt::format("needs at least 3 x 3 nodes, but the grid has {} x {}", nu, nv)));
        }
    }
}

} // namespace
} // namespace millwright::plan
