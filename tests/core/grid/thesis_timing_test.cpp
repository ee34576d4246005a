// Tables 7-1 and 7-2 of (Parasilmongkol 1997, KMITL): ten iterations on 50 x 50 to 150 x 150 nodes, how long
// they take and what threads change. `millwright study run-time` prints the tables.
#include "core/base/parallel.h"
#include "core/grid/jacobi_newton.h"
#include "tests/support/grid_arrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <limits>

namespace millwright::grid {
namespace {

constexpr int iterations = 10;

/// Of all threads of this process, s.
double processor_time() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Timed {
    NodeArray nodes;
    int iterations = 0;
    SolverStatus status = SolverStatus::running;
    double seconds = 0.0; ///< of the processor
};

Timed run(int side, int threads) {
    set_thread_count(threads);
    const EllipticSettings settings{.functional = {.adaptation = 1.0, .orthogonality = 0.0},
                                    .tolerance = 0.0,
                                    .max_iterations = iterations};
    JacobiNewton solver(unit_spaced(side, side), weight_w1(), settings);
    const double before = processor_time();
    const SolverStatus status = solve(solver);
    const double seconds = processor_time() - before;
    set_thread_count(0);
    return {solver.nodes(), solver.iterations(), status, seconds};
}

class ThesisTables : public testing::TestWithParam<int> {};

// T3, T23.
TEST_P(ThesisTables, TenIterationsAreTheSameOnAnyNumberOfThreads) {
    const Timed alone = run(GetParam(), 1);
    EXPECT_EQ(alone.iterations, iterations);
    EXPECT_EQ(alone.status, SolverStatus::iteration_limit);
    EXPECT_NE(alone.nodes, unit_spaced(GetParam(), GetParam())) << "nodes have moved";
    for (const int threads : {2, 8}) {
        EXPECT_EQ(run(GetParam(), threads).nodes, alone.nodes) << threads;
    }
}

INSTANTIATE_TEST_SUITE_P(Sides, ThesisTables, testing::Values(50, 70, 100, 150));

// T23.
TEST(ThesisTable71, AnIterationOn4900NodesTakesLessThanAThousandthOfTheThesiss) {
    constexpr double thesis = 992.345 / 19.0; // s of the processor an iteration, its profile
    EXPECT_LT(run(70, 1).seconds / iterations, thesis / 1000.0);
}

TEST(ThesisTable71, TheTimeGrowsWithTheNodesAndNoFaster) {
    const auto a_node = [](int side) {
        double least = std::numeric_limits<double>::infinity();
        for (int k = 0; k < 5; ++k) {
            least = std::min(least, run(side, 1).seconds);
        }
        return least / (side * side);
    };
    EXPECT_LT(a_node(150), 3.0 * a_node(50)); // the thesis's: 4.4 times, with more iterations
}

} // namespace
} // namespace millwright::grid
