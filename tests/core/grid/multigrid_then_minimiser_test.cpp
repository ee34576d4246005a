#include "core/grid/multigrid.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

namespace millwright::grid {
namespace {

EllipticSettings minimiser_adaptation(double LV, int most_iterations) {
    return {.functional = {.adaptation = LV, .orthogonality = 0.0}, .max_iterations = most_iterations};
}

TEST(MultigridThenMinimiser, IsMultigridWhereThatConverges) {
    const WeightPtr weight = smooth_ring_weight(33, 33);
    Multigrid alone(square_grid(33), weight, minimiser_adaptation(5.0, 100));
    MultigridThenMinimiser solver(square_grid(33), weight, minimiser_adaptation(5.0, 100));
    ASSERT_EQ(solve(alone), SolverStatus::converged);
    EXPECT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_FALSE(solver.has_fallen_back());
    EXPECT_EQ(solver.nodes(), alone.nodes());
    EXPECT_EQ(solver.iterations(), alone.iterations());
}

TEST(MultigridThenMinimiser, ConvergesWithoutAFoldWhereMultigridStalls) {
    Multigrid alone(square_grid(25), weight_w1(), minimiser_adaptation(100.0, 3000));
    ASSERT_EQ(solve(alone), SolverStatus::stalled);
    MultigridThenMinimiser solver(square_grid(25), weight_w1(), minimiser_adaptation(100.0, 3000));
    int before = 0;
    while (solver.iterate()) {
        ASSERT_EQ(solver.iterations(), before + 1);
        before = solver.iterations();
        ASSERT_GT(min_corner_jacobian(solver.nodes()), 0.0);
    }
    EXPECT_TRUE(solver.has_fallen_back());
    EXPECT_EQ(solver.status(), SolverStatus::converged);
    EXPECT_LE(solver.norm(), 1e-3);
}

TEST(MultigridThenMinimiser, KeepsToTheIterationsThatItHasAltogether) {
    MultigridThenMinimiser solver(square_grid(25), weight_w1(), minimiser_adaptation(100.0, 40));
    EXPECT_EQ(solve(solver), SolverStatus::iteration_limit);
    EXPECT_TRUE(solver.has_fallen_back());
    EXPECT_EQ(solver.iterations(), 40);
}

TEST(MultigridThenMinimiser, GoesOnFromItsCloneAsItself) {
    MultigridThenMinimiser solver(square_grid(25), weight_w1(), minimiser_adaptation(100.0, 3000));
    while (!solver.has_fallen_back()) {
        solver.iterate();
    }
    solver.iterate();
    const auto twin = solver.clone();
    solver.iterate();
    twin->iterate();
    EXPECT_EQ(solver.nodes(), twin->nodes());
    EXPECT_EQ(solver.iterations(), twin->iterations());
}

} // namespace
} // namespace millwright::grid
