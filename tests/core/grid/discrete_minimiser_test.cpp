#include "core/grid/discrete_minimiser.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/jacobi_newton.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace millwright::grid {
namespace {

EllipticSettings settings(double LV, Boundary boundary = Boundary::fixed) {
    EllipticSettings s;
    s.functional.adaptation = LV;
    s.max_iterations = 1000;
    s.boundary = boundary;
    return s;
}

TEST(DiscreteFunctional, OfTheUniformGridIsTheIntegral) {
    // Per unit cell: smoothness 2, volume w, orthogonality 0.
    const FunctionalWeights lambda{.adaptation = 3.0, .orthogonality = 5.0};
    const DiscreteFunctional found = discrete_functional(unit_spaced(6, 9), *constant_weight(0.7), lambda);
    EXPECT_NEAR(found.value, 40.0 * (2.0 + 2.0 * 3.0 * 0.7), 1e-10);
}

// T12.
TEST(DiscreteFunctional, HasTheGradientOfItsValue) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> away(-0.2, 0.2);
    NodeArray nodes = unit_spaced(6, 5);
    for (Vec2& p : nodes.nodes) {
        p += Vec2(away(random), away(random));
    }
    const WeightPtr w = ring_weight({.centre = {2.0, 2.0}, .radius_squared = 3.0});
    const FunctionalWeights lambda{.adaptation = 4.0, .orthogonality = 0.5};
    const DiscreteFunctional found = discrete_functional(nodes, *w, lambda);
    constexpr double h = 1e-6;
    for (std::size_t k = 0; k < nodes.nodes.size(); ++k) {
        for (const Eigen::Index c : {0, 1}) {
            NodeArray ahead = nodes;
            NodeArray back = nodes;
            ahead.nodes[k][c] += h;
            back.nodes[k][c] -= h;
            const double expected =
                (discrete_functional(ahead, *w, lambda).value - discrete_functional(back, *w, lambda).value) /
                (2.0 * h);
            EXPECT_NEAR(found.gradient.nodes[k][c], expected, 1e-5 * (1.0 + std::abs(expected)));
        }
    }
}

TEST(DiscreteFunctional, HasMinusTwiceTheResidualAsGradientOnASmoothGrid) {
    // A smooth displacement on a fine grid: both are second order, so they agree to a few percent.
    const NodeArray nodes = displaced_square_grid(49, 2.0);
    const FunctionalWeights lambda{.adaptation = 0.0, .orthogonality = 0.0};
    const auto gradient = discrete_functional(nodes, *constant_weight(1.0), lambda).gradient;
    const auto equations = all_equations(nodes, std::vector<double>(49 * 49, 1.0), {.functional = lambda});
    double largest = 0.0;
    double difference = 0.0;
    for (int i = 1; i < 48; ++i) {
        for (int j = 1; j < 48; ++j) {
            const NodeEquations& e = equations[nodes.index(i, j)];
            const Vec2 expected = -2.0 * Vec2(e.R_X, e.R_Y);
            largest = std::max(largest, expected.norm());
            difference = std::max(difference, (gradient.at(i, j) - expected).norm());
        }
    }
    EXPECT_LT(difference, 0.05 * largest);
}

TEST(DiscreteFunctional, OfAFoldedGridIsInfinite) {
    NodeArray nodes = square_grid(4);
    nodes.at(1, 1) = Vec2(2.5, 2.5);
    const DiscreteFunctional found = discrete_functional(nodes, *constant_weight(1.0), {});
    EXPECT_TRUE(std::isinf(found.value));
    EXPECT_TRUE(found.gradient.nodes.empty());
}

TEST(DiscreteMinimiser, FindsWhatTheReferenceFindsWithASmoothWeight) {
    const WeightPtr hill = weight_from([](const Vec2& p) {
        const Vec2 away = p - Vec2(10.0, 14.0);
        const double w = std::exp(-away.squaredNorm() / 40.0);
        return WeightAndSlope{w + 0.2, -w / 20.0 * away};
    });
    EllipticSettings mild = settings(1.0);
    mild.tolerance = 1e-5;
    mild.max_iterations = 20000;
    JacobiNewton reference(square_grid(25), hill, mild);
    DiscreteMinimiser minimiser(square_grid(25), hill, mild);
    ASSERT_EQ(solve(reference), SolverStatus::converged);
    ASSERT_EQ(solve(minimiser), SolverStatus::converged);
    double moved = 0.0;
    double apart = 0.0;
    const NodeArray start = square_grid(25);
    for (std::size_t k = 0; k < start.nodes.size(); ++k) {
        moved = std::max(moved, (reference.nodes().nodes[k] - start.nodes[k]).norm());
        apart = std::max(apart, (reference.nodes().nodes[k] - minimiser.nodes().nodes[k]).norm());
    }
    EXPECT_GT(moved, 0.3);
    EXPECT_LT(apart, 0.05 * moved);
}

TEST(DiscreteMinimiser, ConvergesWithoutAFoldWhereTheReferenceFolds) {
    DiscreteMinimiser solver(square_grid(25), weight_w1(), settings(100.0));
    while (solver.iterate()) {
        ASSERT_GT(min_corner_jacobian(solver.nodes()), 0.0);
    }
    EXPECT_EQ(solver.status(), SolverStatus::converged);
    EXPECT_LT(solver.iterations(), 500);
}

TEST(DiscreteMinimiser, DecreasesTheFunctionalInEveryIteration) {
    DiscreteMinimiser solver(square_grid(25), weight_w1(), settings(30.0, Boundary::sliding));
    double before = solver.value();
    while (solver.iterate()) {
        EXPECT_LT(solver.value(), before);
        before = solver.value();
    }
}

TEST(DiscreteMinimiser, LeavesAUniformGridAloneWhenTheWeightIsConstant) {
    DiscreteMinimiser solver(unit_spaced(9, 12), constant_weight(2.0), settings(50.0, Boundary::sliding));
    EXPECT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_EQ(solver.iterations(), 1);
    EXPECT_LT(solver.norm(), 1e-12);
    const NodeArray uniform = unit_spaced(9, 12);
    for (std::size_t k = 0; k < uniform.nodes.size(); ++k) {
        EXPECT_LT((solver.nodes().nodes[k] - uniform.nodes[k]).norm(), 1e-12);
    }
}

// T15.
TEST(DiscreteMinimiser, DoesNotMoveAFixedBoundaryByOneBit) {
    NodeArray start = square_grid(15);
    start.at(0, 7).x() = 0.0123;
    DiscreteMinimiser solver(start, weight_w1(), settings(50.0));
    solve(solver);
    for (int k = 0; k < 15; ++k) {
        EXPECT_EQ(solver.nodes().at(0, k), start.at(0, k));
        EXPECT_EQ(solver.nodes().at(14, k), start.at(14, k));
        EXPECT_EQ(solver.nodes().at(k, 0), start.at(k, 0));
        EXPECT_EQ(solver.nodes().at(k, 14), start.at(k, 14));
    }
}

TEST(DiscreteMinimiser, SlidesTheBoundaryAlongItsSidesAndKeepsTheCorners) {
    DiscreteMinimiser solver(square_grid(25), weight_w3(24, 24), settings(50.0, Boundary::sliding));
    solve(solver);
    const NodeArray& nodes = solver.nodes();
    EXPECT_EQ(nodes.at(0, 0), Vec2(0.0, 0.0));
    EXPECT_EQ(nodes.at(24, 0), Vec2(24.0, 0.0));
    EXPECT_EQ(nodes.at(24, 24), Vec2(24.0, 24.0));
    double moved = 0.0;
    for (int k = 1; k < 24; ++k) {
        EXPECT_EQ(nodes.at(24, k).x(), 24.0);
        EXPECT_EQ(nodes.at(k, 0).y(), 0.0);
        EXPECT_GT(nodes.at(24, k).y(), nodes.at(24, k - 1).y());
        moved = std::max(moved, std::abs(nodes.at(24, k).y() - k));
    }
    EXPECT_GT(moved, 0.3);
}

/// Up to five bumps of any width and height, positive.
WeightPtr random_weight(std::mt19937& random, double size) {
    struct Bump {
        Vec2 at;
        double height, width;
    };
    std::uniform_real_distribution<double> place(0.0, size);
    std::vector<Bump> bumps;
    const int count = std::uniform_int_distribution(1, 5)(random);
    for (int n = 0; n < count; ++n) {
        bumps.push_back({{place(random), place(random)},
                         std::uniform_real_distribution(0.1, 1.0)(random),
                         std::uniform_real_distribution(1.0, 8.0)(random)});
    }
    return weight_from([bumps](const Vec2& p) {
        double w = 0.01;
        Vec2 slope = Vec2::Zero();
        for (const Bump& bump : bumps) {
            const Vec2 away = p - bump.at;
            const double value = bump.height * std::exp(-away.squaredNorm() / (bump.width * bump.width));
            w += value;
            slope -= 2.0 * value / (bump.width * bump.width) * away;
        }
        return WeightAndSlope{w, slope};
    });
}

// T15.
TEST(EllipticSolvers, NeverAcceptAFoldedGridWhateverTheSmoothWeight) {
    const unsigned seed = 20251121;
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    int converged = 0;
    for (int n = 0; n < 12; ++n) {
        const WeightPtr w = random_weight(random, 15.0);
        const double LV = std::pow(10.0, std::uniform_real_distribution(-1.0, 3.0)(random));
        const Boundary boundary = n % 2 == 0 ? Boundary::fixed : Boundary::sliding;
        JacobiNewton reference(square_grid(16), w, settings(LV, boundary));
        DiscreteMinimiser minimiser(square_grid(16), w, settings(LV, boundary));
        for (EllipticSolver* solver :
             {static_cast<EllipticSolver*>(&reference), static_cast<EllipticSolver*>(&minimiser)}) {
            const SolverStatus status = solve(*solver);
            const bool accepted = status == SolverStatus::converged ||
                                  status == SolverStatus::iteration_limit || status == SolverStatus::stalled;
            EXPECT_EQ(accepted, all_finite(solver->nodes()) && min_corner_jacobian(solver->nodes()) > 0.0);
            converged += status == SolverStatus::converged ? 1 : 0;
        }
        EXPECT_NE(minimiser.status(), SolverStatus::folded);
    }
    EXPECT_GT(converged, 8); // or nothing was tested
}

// T21.
TEST(DiscreteMinimiser, GivesTheSameBytesOnAnyNumberOfThreads) {
    std::vector<NodeArray> found;
    for (const int threads : {1, 2, 7}) {
        set_thread_count(threads);
        EllipticSettings s = settings(20.0, Boundary::sliding);
        s.max_iterations = 25;
        DiscreteMinimiser solver(unit_spaced(60, 50), weight_w1(), s);
        solve(solver);
        found.push_back(solver.nodes());
    }
    set_thread_count(0);
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
}

TEST(DiscreteMinimiser, SaysWhatIsWrongWithItsStartOrWeight) {
    NodeArray folded = square_grid(5);
    folded.at(2, 2) = Vec2(0.2, 0.2);
    DiscreteMinimiser from_folded(folded, weight_w1(), {});
    EXPECT_FALSE(from_folded.iterate());
    EXPECT_EQ(from_folded.status(), SolverStatus::folded);

    DiscreteMinimiser not_finite(square_grid(5), broken_weight(std::numeric_limits<double>::quiet_NaN()), {});
    EXPECT_EQ(solve(not_finite), SolverStatus::not_finite);

    EXPECT_THROW(DiscreteMinimiser(square_grid(5), WeightPtr(), {}), Defect);
}

TEST(DiscreteMinimiser, ClonedGoesItsOwnWay) {
    DiscreteMinimiser solver(square_grid(15), weight_w1(), settings(10.0));
    solver.iterate();
    const auto clone = solver.clone();
    const NodeArray before = solver.nodes();
    clone->iterate();
    EXPECT_EQ(solver.nodes(), before);
    solver.iterate();
    EXPECT_EQ(solver.nodes(), clone->nodes());
}

} // namespace
} // namespace millwright::grid
