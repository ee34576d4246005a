#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/weight.h"
#include "tests/core/grid/short_names.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/spike_error_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace millwright::grid {
namespace {

using test::infinity;

Grid bent_grid(int nu, int nv) {
    NodeArray nodes = Grid::uniform(nu, nv).array();
    for (int i = 1; i + 1 < nu; ++i) {
        for (int j = 1; j + 1 < nv; ++j) {
            nodes.at(i, j) += Vec2(0.2 / nu * std::sin(5.0 * j), 0.2 / nv * std::sin(3.0 * i));
        }
    }
    return Grid(std::move(nodes));
}

double weight_at(const Weight& weight, const Vec2& p) {
    double w = 0.0;
    weight.values({&p, 1}, {&w, 1});
    return w;
}

TEST(SolverCoordinates, GoThereAndBackWithExactEnds) {
    const NodeArray there = to_solver_coordinates(Grid::uniform(7, 12).array());
    EXPECT_EQ(there.at(6, 11), Vec2(6.0, 11.0));
    EXPECT_NEAR(there.at(3, 4).x(), 3.0, 1e-12);
    const NodeArray back = to_parameters(there);
    EXPECT_EQ(back.at(6, 0), Vec2(1.0, 0.0));
    EXPECT_NEAR(back.at(3, 4).y(), 4.0 / 11.0, 1e-15);
}

// T16.
TEST(ErrorDensity, OfAnErrorKappaHSquaredIsKappaWhateverTheSteps) {
    // 5 x 5 nodes: h^2 in solver coordinates is 16 times that in parameters.
    const SpikeErrorModel model({.background = 32.0, .height = 0.0, .limit = 1e12});
    NodeArray nodes = Grid::uniform(5, 5).array();
    nodes.at(2, 2).y() = 0.6;
    nodes.at(3, 1).y() = 0.3;
    const Grid grid(nodes);
    for (const TrackDirection direction : {TrackDirection::along_u, TrackDirection::along_v}) {
        const auto density = error_density(grid, direction, measure(model, grid, direction, coarse));
        for (const double d : density) {
            EXPECT_NEAR(d, 2.0, 1e-6);
        }
    }
}

TEST(ErrorDensity, IsTheLargerOfTheTwoMovesAtANode) {
    const Grid grid = Grid::uniform(2, 3);
    const std::vector<MoveError> moves{{1.0, 0, 1}, {5.0, 0, 1}, {2.0, 0, 1}, {0.0, 0, 1}};
    const auto density = error_density(grid, TrackDirection::along_v, moves);
    EXPECT_EQ(density, (std::vector<double>{1.0, 5.0, 5.0, 2.0, 2.0, 0.0}));
    EXPECT_THROW((void)error_density(grid, TrackDirection::along_u, std::span(moves).first(2)), Defect);
}

TEST(ErrorDensity, TakesAMoveOutOfReachForTheWorstAndRoundingForNothing) {
    const Grid grid = Grid::uniform(2, 3);
    const std::vector<MoveError> moves{{infinity, infinity, 1}, {5.0, 0, 1}, {1e-12, 0, 1}, {2.0, 0, 1}};
    const auto density = error_density(grid, TrackDirection::along_v, moves);
    EXPECT_EQ(density, (std::vector<double>{5.0, 5.0, 5.0, 0.0, 2.0, 2.0}));
}

TEST(ScaledWeight, IsFloorPlusPowerOfTheShareOfTheLargest) {
    const ErrorWeightSettings plain{.exponent = 2.0, .floor = 0.01, .smoothing_passes = 0};
    const auto w = scaled_weight({1.0, 2.0, 4.0, 0.0}, 2, 2, plain);
    EXPECT_DOUBLE_EQ(w[0], 0.0625 + 0.01);
    EXPECT_DOUBLE_EQ(w[1], 0.25 + 0.01);
    EXPECT_DOUBLE_EQ(w[2], 1.0 + 0.01);
    EXPECT_DOUBLE_EQ(w[3], 0.01);
}

TEST(ScaledWeight, WithoutAnyErrorIsOneEverywhere) {
    EXPECT_EQ(scaled_weight({0.0, 0.0, 0.0, 0.0}, 2, 2, {}), (std::vector<double>{1.0, 1.0, 1.0, 1.0}));
}

TEST(NinePointAverage, SpreadsASpikeOverItsNeighboursAndKeepsConstants) {
    std::vector<double> spike(25, 0.0);
    spike[12] = 9.0;
    const auto smooth = nine_point_average(spike, 5, 5);
    EXPECT_DOUBLE_EQ(smooth[12], 1.0);
    EXPECT_DOUBLE_EQ(smooth[6], 1.0);
    EXPECT_DOUBLE_EQ(smooth[0], 0.0);
    const auto constant = nine_point_average(std::vector<double>(12, 2.5), 3, 4);
    EXPECT_TRUE(std::ranges::all_of(constant, [](double v) { return std::abs(v - 2.5) < 1e-15; }));
}

TEST(WeightOn, ReproducesALinearFieldOnABentGrid) {
    const Grid grid = bent_grid(12, 9);
    const NodeArray nodes = to_solver_coordinates(grid.array());
    std::vector<double> w;
    for (const Vec2& p : nodes.nodes) {
        w.push_back(1.0 + 0.3 * p.x() + 0.7 * p.y());
    }
    const WeightPtr weight = weight_on(grid, w);
    std::mt19937 random(5);
    for (int n = 0; n < 300; ++n) { // half a sample from the edge the blend is no longer linear
        const Vec2 p(std::uniform_real_distribution(0.5, 10.5)(random),
                     std::uniform_real_distribution(0.5, 7.5)(random));
        EXPECT_NEAR(weight_at(*weight, p), 1.0 + 0.3 * p.x() + 0.7 * p.y(), 1e-9);
    }
}

TEST(WeightOn, StaysBetweenTheSmallestAndTheLargestNodalWeight) {
    const Grid grid = bent_grid(9, 9);
    std::vector<double> w(81, 0.01);
    w[40] = 1.0;
    const WeightPtr weight = weight_on(grid, w);
    double largest = 0.0;
    for (double x = -1.0; x <= 9.0; x += 0.13) {
        for (double y = -1.0; y <= 9.0; y += 0.17) {
            const double here = weight_at(*weight, {x, y});
            EXPECT_GE(here, 0.01 - 1e-15);
            EXPECT_LE(here, 1.0 + 1e-15);
            largest = std::max(largest, here);
        }
    }
    EXPECT_GT(largest, 0.4);
}

TEST(WeightOn, HasTheGradientOfItsValuesAlsoAcrossSamples) {
    const Grid grid = bent_grid(9, 7);
    std::vector<double> w;
    for (int k = 0; k < 63; ++k) {
        w.push_back(1.0 + std::sin(1.7 * k));
    }
    const WeightPtr weight = weight_on(grid, w);
    constexpr double h = 1e-6;
    std::mt19937 random(9);
    for (int n = 0; n < 300; ++n) {
        const Vec2 p(std::uniform_real_distribution(0.1, 7.9)(random),
                     std::uniform_real_distribution(0.1, 5.9)(random));
        Vec2 found = Vec2::Zero();
        weight->gradients({&p, 1}, {&found, 1});
        EXPECT_NEAR(found.x(),
                    (weight_at(*weight, p + Vec2(h, 0)) - weight_at(*weight, p - Vec2(h, 0))) / (2 * h),
                    1e-5);
        EXPECT_NEAR(found.y(),
                    (weight_at(*weight, p + Vec2(0, h)) - weight_at(*weight, p - Vec2(0, h))) / (2 * h),
                    1e-5);
    }
}

} // namespace
} // namespace millwright::grid
