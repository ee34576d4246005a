#include "core/grid/corner_functionals.h"
#include "core/grid/discrete_minimiser.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::grid {
namespace {

NodeArray disturbed(int rows, int columns) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> away(-0.2, 0.2);
    NodeArray nodes = unit_spaced(rows, columns);
    for (Vec2& p : nodes.nodes) {
        p += Vec2(away(random), away(random));
    }
    return nodes;
}

TEST(HarmonicFunctional, HasTheGradientOfItsValue) {
    const NodeArray nodes = disturbed(6, 5);
    const WeightPtr m = ring_weight({.centre = {2.0, 2.0}, .radius_squared = 3.0});
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const DiscreteFunctional found = harmonic_functional(nodes, *m, direction);
        constexpr double h = 1e-6;
        for (std::size_t k = 0; k < nodes.nodes.size(); ++k) {
            for (const Eigen::Index c : {0, 1}) {
                NodeArray ahead = nodes;
                NodeArray back = nodes;
                ahead.nodes[k][c] += h;
                back.nodes[k][c] -= h;
                const double expected = (harmonic_functional(ahead, *m, direction).value -
                                         harmonic_functional(back, *m, direction).value) /
                                        (2.0 * h);
                EXPECT_NEAR(found.gradient.nodes[k][c], expected, 1e-4 * (1.0 + std::abs(expected)));
            }
        }
    }
}

TEST(HarmonicFunctional, WithAMetricOfOneIsTheSmoothnessOfTheGrid) {
    const NodeArray nodes = disturbed(7, 4);
    const double smoothness =
        discrete_functional(nodes, *constant_weight(1.0), {.adaptation = 0.0, .orthogonality = 0.0}).value;
    EXPECT_NEAR(
        harmonic_functional(nodes, *constant_weight(1.0), TrackDirection::along_u).value, smoothness, 1e-9);
    EXPECT_NEAR(
        harmonic_functional(nodes, *constant_weight(1.0), TrackDirection::along_v).value, smoothness, 1e-9);
}

/// m depends on the place along the track alone: then each row solves x' m = constant, in closed form.
TEST(HarmonicFunctional, EvensOutTheMetricAlongTheTracks) {
    constexpr int n = 41;
    constexpr double steep = 0.05; // m = exp(steep x)
    const WeightPtr m = weight_from([](const Vec2& p) {
        const double value = std::exp(steep * p.x());
        return WeightAndSlope{value, Vec2(steep * value, 0.0)};
    });
    EllipticSettings settings;
    settings.boundary = Boundary::sliding;
    settings.tolerance = 1e-7;
    settings.max_iterations = 3000;
    DiscreteMinimiser solver(
        unit_spaced(n, 5),
        [&](const NodeArray& nodes) { return harmonic_functional(nodes, *m, TrackDirection::along_u); },
        settings);
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    const double all = std::exp(steep * (n - 1)) - 1.0;
    for (int i = 0; i < n; ++i) {
        const double expected = std::log1p(all * i / (n - 1)) / steep;
        for (int j = 0; j < 5; ++j) {
            EXPECT_NEAR(solver.nodes().at(i, j).x(), expected, 0.08) << i << " " << j;
            EXPECT_NEAR(solver.nodes().at(i, j).y(), j, 1e-3);
        }
    }
}

TEST(HarmonicFunctional, OfAFoldedGridIsInfinite) {
    NodeArray nodes = square_grid(4);
    nodes.at(1, 1) = Vec2(2.5, 2.5);
    EXPECT_TRUE(std::isinf(harmonic_functional(nodes, *constant_weight(1.0), TrackDirection::along_u).value));
}

} // namespace
} // namespace millwright::grid
