// The judge is JacobiNewton: other code that solves the same equations, run to a norm at which the grids can
// differ by 1e-6 of a cell at most.
#include "core/grid/multigrid.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/grid/jacobi_newton.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <cmath>
#include <limits>
#include <string>

namespace millwright::grid {
namespace {

EllipticSettings to_norm(double tolerance, double LV, Boundary boundary = Boundary::fixed, double LO = 0.0) {
    return {.functional = {.adaptation = LV, .orthogonality = LO},
            .tolerance = tolerance,
            .max_iterations = 20000,
            .boundary = boundary};
}

double farthest(const NodeArray& a, const NodeArray& b) {
    double found = 0.0;
    for (std::size_t k = 0; k < a.nodes.size(); ++k) {
        found = std::max(found, (a.nodes[k] - b.nodes[k]).norm());
    }
    return found;
}

struct SolvedCase {
    std::string name;
    int rows, columns;
    double LV, LO;
    Boundary boundary;
};

void PrintTo(const SolvedCase& tested, std::ostream* out) {
    *out << tested.name;
}

class MultigridCase : public testing::TestWithParam<SolvedCase> {};

TEST_P(MultigridCase, FindsTheGridOfTheReferenceIteration) {
    const auto& [name, rows, columns, LV, LO, boundary] = GetParam();
    const NodeArray start = unit_spaced(rows, columns);
    const WeightPtr weight = smooth_ring_weight(rows, columns);
    const EllipticSettings settings = to_norm(1e-8, LV, boundary, LO);
    JacobiNewton reference(start, weight, settings);
    Multigrid solver(start, weight, settings);
    ASSERT_EQ(solve(reference), SolverStatus::converged);
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_LT(farthest(solver.nodes(), reference.nodes()), 1e-6);
    EXPECT_GT(farthest(solver.nodes(), start), 0.05); // it is no accident: the weight moves them
    EXPECT_LT(solver.iterations(), 40);
    EXPECT_GT(reference.iterations(), 5 * solver.iterations());
}

INSTANTIATE_TEST_SUITE_P(AllKinds,
                         MultigridCase,
                         testing::Values(SolvedCase{"Square", 25, 25, 1.0, 0.0, Boundary::fixed},
                                         SolvedCase{"NoPowerOfTwo", 22, 19, 1.0, 0.0, Boundary::fixed},
                                         SolvedCase{"Long", 5, 30, 1.0, 0.0, Boundary::fixed},
                                         SolvedCase{"Tiny", 7, 6, 5.0, 0.0, Boundary::fixed},
                                         SolvedCase{"Orthogonal", 20, 20, 1.0, 0.2, Boundary::fixed},
                                         SolvedCase{"Sliding", 16, 21, 1.0, 0.0, Boundary::sliding},
                                         SolvedCase{"Strong", 17, 17, 10.0, 0.0, Boundary::fixed}),
                         [](const auto& tested) { return tested.param.name; });

TEST(Multigrid, SmoothsADisplacedGridBackToTheUniformOne) {
    Multigrid solver(displaced_square_grid(25, 1.2), constant_weight(1.0), to_norm(1e-10, 0.0));
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_LT(farthest(solver.nodes(), square_grid(25)), 1e-8);
}

// T16.
TEST(Multigrid, LeavesAUniformGridWithAConstantWeightAloneToTheBit) {
    Multigrid solver(unit_spaced(17, 12), constant_weight(3.0), to_norm(1e-12, 10.0));
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_EQ(solver.iterations(), 1);
    EXPECT_EQ(solver.nodes(), unit_spaced(17, 12));
}

TEST(Multigrid, TakesHardlyMoreCyclesForManyTimesTheNodes) {
    const auto cycles = [](int n) {
        Multigrid solver(square_grid(n), smooth_ring_weight(n, n), to_norm(1e-6, 1.0));
        EXPECT_EQ(solve(solver), SolverStatus::converged);
        return solver.iterations();
    };
    EXPECT_LE(cycles(150), cycles(38) + 3);
}

// T15.
TEST(Multigrid, NeitherMovesAFixedOutlineNorLeavesTheSidesWhenSliding) {
    const NodeArray start = unit_spaced(20, 27);
    for (const Boundary boundary : {Boundary::fixed, Boundary::sliding}) {
        Multigrid solver(start, smooth_ring_weight(20, 27), to_norm(1e-6, 5.0, boundary));
        ASSERT_EQ(solve(solver), SolverStatus::converged);
        double slid = 0.0;
        for (int i = 0; i < 20; ++i) {
            for (int j : {0, 26}) {
                EXPECT_EQ(solver.nodes().at(i, j).y(), start.at(i, j).y());
                slid = std::max(slid, std::abs(solver.nodes().at(i, j).x() - start.at(i, j).x()));
            }
        }
        EXPECT_EQ(slid > 0.0, boundary == Boundary::sliding);
    }
}

// T21.
TEST(Multigrid, HasTheSameBytesOnAnyNumberOfThreads) {
    const auto nodes_with = [](int threads) {
        set_thread_count(threads);
        Multigrid solver(square_grid(130), weight_w1(), to_norm(1e-5, 2.0));
        for (int k = 0; k < 5; ++k) {
            solver.iterate();
        }
        set_thread_count(0);
        return solver.nodes();
    };
    const NodeArray one = nodes_with(1);
    EXPECT_EQ(one, nodes_with(2));
    EXPECT_EQ(one, nodes_with(8));
}

// T15.
TEST(Multigrid, NeverFoldsACellHoweverStrongTheWeight) {
    for (const double LV : {100.0, 1e4, 1e7}) {
        Multigrid solver(square_grid(33), weight_w1(), to_norm(1e-3, LV));
        bool more = true;
        while (more) {
            more = solver.iterate();
            ASSERT_GT(min_corner_jacobian(solver.nodes()), 0.0) << LV;
        }
        EXPECT_NE(solver.status(), SolverStatus::folded);
        EXPECT_LT(solver.iterations(), 1000) << "it gives up where it does not get on";
    }
}

TEST(Multigrid, SaysThatItStallsWhereTheWeightHasNoGround) {
    // w < 0 everywhere: the functional falls without end as cells grow
    Multigrid solver(square_grid(17), constant_weight(-1.0), to_norm(1e-3, 1.0));
    EXPECT_EQ(solve(solver), SolverStatus::converged); // constant: the uniform grid is a solution
    const auto wave = weight_from([](const Vec2& p) {
        return WeightAndSlope{-50.0 * (1.0 + std::sin(p.x()) * std::sin(p.y())), Vec2::Zero()};
    });
    Multigrid other(square_grid(17), wave, to_norm(1e-6, 10.0));
    const SolverStatus ended = solve(other);
    EXPECT_TRUE(ended == SolverStatus::stalled || ended == SolverStatus::iteration_limit);
    EXPECT_GT(min_corner_jacobian(other.nodes()), 0.0);
}

// T14.
TEST(Multigrid, ReportsAFoldedStartAndWeightsThatAreNoNumbers) {
    const test::WithoutTraps quiet;
    NodeArray folded = square_grid(9);
    folded.at(4, 4) = Vec2(7.5, 4.0);
    Multigrid of_folded(folded, weight_w1(), to_norm(1e-3, 1.0));
    EXPECT_EQ(solve(of_folded), SolverStatus::folded);
    EXPECT_EQ(of_folded.nodes(), folded);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Multigrid solver(square_grid(9), broken_weight(bad), to_norm(1e-3, 1.0));
        EXPECT_EQ(solve(solver), SolverStatus::not_finite);
        EXPECT_TRUE(all_finite(solver.nodes()));
    }
    EXPECT_THROW(Multigrid(unit_spaced(2, 9), weight_w1(), to_norm(1e-3, 1.0)), Defect);
}

TEST(Multigrid, GoesOnFromItsCloneAsItself) {
    Multigrid solver(square_grid(40), weight_w1(), to_norm(1e-9, 5.0));
    solver.iterate();
    solver.iterate();
    const auto twin = solver.clone();
    solver.iterate();
    twin->iterate();
    EXPECT_EQ(solver.nodes(), twin->nodes());
    EXPECT_EQ(solver.norm(), twin->norm());
}

#ifndef MILLWRIGHT_OWN_ALLOCATOR
TEST(Multigrid, TakesTheMemoryThatItAnnounces) {
    const auto held = [] {
        const struct mallinfo2 info = mallinfo2();
        return info.uordblks + info.hblkhd;
    };
    const std::size_t before = held();
    Multigrid solver(unit_spaced(200, 301), smooth_ring_weight(200, 301), to_norm(0.0, 1.0));
    for (int k = 0; k < 6; ++k) {
        solver.iterate();
    }
    const auto taken = static_cast<double>(held() - before);
    const auto told = static_cast<double>(Multigrid::memory_bytes(200, 301));
    EXPECT_LT(taken, told);
    EXPECT_GT(taken, 0.4 * told); // the rest is taken for the length of a cycle
}
#endif

} // namespace
} // namespace millwright::grid
