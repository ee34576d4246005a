#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/path_descent.h"
#include "tests/support/shaken_nodes.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <cmath>

namespace millwright::grid {
namespace {

const SpikeErrorModel default_spike({});

PathObjective spike_objective(const NodeArray& nodes, TrackDirection direction) {
    PathObjectiveSettings settings;
    settings.unit_cost = 0.05;
    return {default_spike, direction, nodes, settings};
}

/// Inside both ways, on a side along it, in a corner not at all.
bool may_move(const NodeArray& nodes, std::size_t n, int coordinate) {
    const int i = static_cast<int>(n) / nodes.columns;
    const int j = static_cast<int>(n) % nodes.columns;
    const bool row_side = i == 0 || i == nodes.rows - 1;
    const bool column_side = j == 0 || j == nodes.columns - 1;
    return coordinate == 0 ? !row_side : !column_side;
}

class PathObjectiveTest : public ::testing::TestWithParam<TrackDirection> {};

TEST_P(PathObjectiveTest, ItsGradientIsTheDifferenceOfItsValue) {
    const NodeArray nodes = test::shaken(7, 9, 0.2);
    const PathObjective f = spike_objective(nodes, GetParam());
    const std::vector<Vec2> gradient = f.gradient(nodes, {});
    for (std::size_t n = 0; n < gradient.size(); ++n) {
        for (const int coordinate : {0, 1}) {
            std::vector<Vec2> step(gradient.size(), Vec2::Zero());
            step[n][coordinate] = 1.0;
            constexpr double h = 2e-4;
            const double ahead = f.value(f.moved(nodes, h, step), {});
            const double behind = f.value(f.moved(nodes, -h, step), {});
            const double slope = may_move(nodes, n, coordinate) ? (ahead - behind) / (2.0 * h) : 0.0;
            EXPECT_NEAR(gradient[n][coordinate], slope, 1e-6 * (1.0 + std::abs(ahead)));
        }
    }
}

TEST_P(PathObjectiveTest, IsTheSameBytesOnAnyNumberOfThreads) {
    const NodeArray nodes = test::shaken(12, 10, 0.2);
    const PathObjective f = spike_objective(nodes, GetParam());
    set_thread_count(1);
    const double value = f.value(nodes, {});
    const std::vector<Vec2> gradient = f.gradient(nodes, {});
    for (const int threads : {2, 8}) {
        set_thread_count(threads);
        EXPECT_EQ(f.value(nodes, {}), value);
        EXPECT_EQ(f.gradient(nodes, {}), gradient);
    }
    set_thread_count(0);
}

TEST_P(PathObjectiveTest, ADescentLessensTheErrorAndFoldsNothing) {
    const NodeArray start = Grid::uniform(10, 12).array();
    const PathObjective f = spike_objective(start, GetParam());
    PathDescent descent(f, start, {});
    double before = descent.value();
    const double first = before;
    for (int n = 0; n < 60 && descent.iterate({}); ++n) {
        EXPECT_LT(descent.value(), before);
        before = descent.value();
        ASSERT_GT(min_corner_jacobian(descent.nodes()), 0.0);
        EXPECT_EQ(descent.nodes().nodes.front(), start.nodes.front());
        EXPECT_EQ(descent.nodes().nodes.back(), start.nodes.back());
    }
    EXPECT_LT(before, 0.7 * first);
    EXPECT_NEAR(f.value(descent.nodes(), {}), before, 1e-12 * first);
}

TEST_P(PathObjectiveTest, IsInfiniteWhereACellFolds) {
    NodeArray nodes = Grid::uniform(5, 5).array();
    const PathObjective f = spike_objective(nodes, GetParam());
    EXPECT_TRUE(std::isfinite(f.value(nodes, {})));
    nodes.at(2, 2) = nodes.at(3, 3);
    EXPECT_TRUE(std::isinf(f.value(nodes, {})));
    EXPECT_THROW(PathDescent(f, nodes, {}), Defect);
}

INSTANTIATE_TEST_SUITE_P(BothWays,
                         PathObjectiveTest,
                         ::testing::Values(TrackDirection::along_u, TrackDirection::along_v));

TEST(PathObjective, TracksThatDriftApartCostMore) {
    const NodeArray uniform = Grid::uniform(5, 5).array();
    const PathObjective f = spike_objective(uniform, TrackDirection::along_v);
    NodeArray apart = uniform;
    for (int j = 0; j < 5; ++j) {
        apart.at(2, j).x() += 0.05; // gaps of 1.2 and 0.8
    }
    PathObjectiveSettings free;
    free.unit_cost = 0.05;
    free.widest_gap = 2.0;
    const PathObjective without(default_spike, TrackDirection::along_v, uniform, free);
    EXPECT_NEAR(f.value(apart, {}) - without.value(apart, {}), 5.0 * 0.75 * 0.75, 1e-9);
    EXPECT_NEAR(f.value(uniform, {}), without.value(uniform, {}), 1e-12);
}

TEST(PathObjective, WantsAnOutlineThatNodesCanSlideAlong) {
    NodeArray bent = Grid::uniform(4, 4).array();
    bent.at(0, 1).x() += 0.01;
    EXPECT_THROW((void)spike_objective(bent, TrackDirection::along_u), Defect);
}

} // namespace
} // namespace millwright::grid
