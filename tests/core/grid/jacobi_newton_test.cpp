// Numbers of an independent implementation of the corrected iteration: start x = i, y = j, 25 x 25, weight
// W1, WW 0.81, LO 0, double precision without fused multiply-add. Iterations to +-1, the norm of the first
// five iterations to 1e-8 relative, end values to 1e-4 relative, node positions to their last digit.
#include "core/grid/jacobi_newton.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace millwright::grid {
namespace {

EllipticSettings newton_adaptation(double LV, int cap) {
    return {.functional = {.adaptation = LV, .orthogonality = 0.0}, .max_iterations = cap};
}

struct At {
    int i, j;
    double x, y;
};

struct Row {
    std::string name;
    double LV;
    int cap;
    SolverStatus status;
    int iterations;
    double norm;
    double min_area;
    std::vector<double> first_norms;
    std::vector<At> nodes;
};

void PrintTo(const Row& row, std::ostream* out) {
    *out << row.name;
}

const std::vector<double> norms_01{0.04051050779, 0.033121216, 0.02732086939, 0.02273304249, 0.01907781206};
const std::vector<double> norms_1{0.4045922466, 0.328164831, 0.2664142164, 0.2161995387, 0.175208779};

const std::vector<Row> reference_rows{
    {"LV0", 0.0, 250, SolverStatus::converged, 1, 0.0, 1.0, {}, {}},
    {"LV01",
     0.1,
     250,
     SolverStatus::converged,
     81,
     9.9060279e-4,
     0.96088,
     norms_01,
     {{10, 5, 10.0, 5.0027023},
      {12, 12, 12.0067397, 12.0067397},
      {15, 15, 14.9923104, 14.9923104},
      {10, 15, 10.0, 14.9972890}}},
    {"LV1cap220", 1.0, 220, SolverStatus::iteration_limit, 220, 5.9065858e-3, 0.802529, norms_1, {}},
    {"LV1cap250", 1.0, 250, SolverStatus::iteration_limit, 250, 5.2608332e-3, 0.800441, norms_1, {}},
    {"LV1",
     1.0,
     5000,
     SolverStatus::converged,
     836,
     9.9976113e-4,
     0.785828,
     norms_1,
     {{10, 5, 9.9946190, 5.0664571},
      {10, 10, 9.9919842, 9.9919842},
      {12, 12, 11.9973491, 11.9973491},
      {15, 15, 14.8922107, 14.8922107},
      {10, 15, 9.9905609, 14.9092794}}},
    {"LV5", 5.0, 5000, SolverStatus::converged, 2106, 9.9952875e-4, 0.529167, {}, {}},
    {"LV10cap250", 10.0, 250, SolverStatus::iteration_limit, 250, 5.8345507e-2, 0.434964, {}, {}},
    {"LV10",
     10.0,
     5000,
     SolverStatus::converged,
     2702,
     9.9686145e-4,
     0.284583,
     {},
     {{10, 5, 9.8371301, 5.3447319}, {15, 15, 14.2011462, 14.2011462}, {3, 3, 3.1187971, 3.1187971}}},
};

class JacobiNewtonRow : public testing::TestWithParam<Row> {};

// T13.
TEST_P(JacobiNewtonRow, HoldsAndNoIterationFolds) {
    const Row& row = GetParam();
    JacobiNewton solver(square_grid(25), weight_w1(), newton_adaptation(row.LV, row.cap));
    std::vector<double> norms;
    do {
        solver.iterate();
        norms.push_back(solver.norm());
        ASSERT_GT(min_cell_area(solver.nodes()), 0.2);
    } while (solver.status() == SolverStatus::running);

    EXPECT_EQ(solver.status(), row.status);
    EXPECT_NEAR(solver.iterations(), row.iterations, 1);
    EXPECT_NEAR(solver.norm(), row.norm, 1e-4 * row.norm);
    EXPECT_NEAR(min_cell_area(solver.nodes()), row.min_area, 1e-4 * row.min_area);
    for (std::size_t k = 0; k < row.first_norms.size(); ++k) {
        EXPECT_NEAR(norms[k], row.first_norms[k], 1e-8 * row.first_norms[k]);
    }
    for (const At& at : row.nodes) {
        EXPECT_NEAR(solver.nodes().at(at.i, at.j).x(), at.x, 2e-7);
        EXPECT_NEAR(solver.nodes().at(at.i, at.j).y(), at.y, 2e-7);
    }
}

INSTANTIATE_TEST_SUITE_P(Table, JacobiNewtonRow, testing::ValuesIn(reference_rows), [](const auto& tested) {
    return tested.param.name;
});

TEST(JacobiNewton, IsSymmetricAboutTheDiagonalAsItsWeightIs) {
    JacobiNewton solver(square_grid(25), weight_w1(), newton_adaptation(1.0, 5000));
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    for (int i = 0; i < 25; ++i) {
        for (int j = 0; j < 25; ++j) {
            const Vec2 mirrored(solver.nodes().at(j, i).y(), solver.nodes().at(j, i).x());
            EXPECT_LT((solver.nodes().at(i, j) - mirrored).norm(), 1e-9);
        }
    }
}

// T14.
TEST(JacobiNewton, ReportsAFoldAtTheFirstIterationWithAWeightTooStrongForIt) {
    JacobiNewton solver(square_grid(25), weight_w1(), newton_adaptation(100.0, 220));
    EXPECT_EQ(solve(solver), SolverStatus::folded);
    EXPECT_EQ(solver.iterations(), 1);
    EXPECT_NEAR(solver.norm(), 189.082913, 1e-8 * 189.0);
    EXPECT_NEAR(min_cell_area(solver.nodes()), -1.271578, 1e-6);
    double smallest = std::numeric_limits<double>::infinity();
    for (const NodeEquations& e : solver.equations()) {
        smallest = std::min(smallest, e.J);
    }
    EXPECT_NEAR(smallest, -0.33143529, 1e-8);
    EXPECT_FALSE(solver.iterate());

    NodeArray folded = solver.nodes(); // the next iteration of the plain scheme is known, too
    relax(folded, solver.equations(), Boundary::fixed, 0.81);
    const EquationRules rules{.functional = {.adaptation = 100.0}};
    EXPECT_NEAR(residual_norm(all_equations(folded, weight_at_nodes(*weight_w1(), folded), rules)),
                299.7233628,
                1e-8 * 300.0);
}

// T14.
TEST(JacobiNewton, WithTheListedDerivativesIsReportedFoldedInsteadOfConvergedByNaN) {
    EllipticSettings settings = newton_adaptation(1.0, 220);
    settings.derivatives = WeightDerivatives::listed;
    JacobiNewton solver(square_grid(25), weight_w1(), settings);
    ASSERT_TRUE(solver.iterate());
    EXPECT_NEAR(solver.norm(), 7.7945735e4, 1e-4 * 7.8e4);
    EXPECT_NEAR(min_cell_area(solver.nodes()), 0.9765362, 1e-7);
    ASSERT_FALSE(solver.iterate());
    EXPECT_EQ(solver.status(), SolverStatus::folded);
    EXPECT_NEAR(min_cell_area(solver.nodes()), -3656.910, 0.01);
}

// T13.
TEST(JacobiNewton, SmoothesADisplacedGridBackToTheUniformOne) {
    JacobiNewton solver(displaced_square_grid(25, 1.2), constant_weight(1.0), newton_adaptation(0.0, 5000));
    solver.iterate();
    EXPECT_NEAR(solver.norm(), 0.1506331222, 1e-8 * 0.15);
    solver.iterate();
    EXPECT_NEAR(solver.norm(), 0.1492094648, 1e-8 * 0.15);
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_NEAR(solver.iterations(), 982, 1);
    EXPECT_NEAR(solver.norm(), 9.986414e-4, 1e-4 * 1e-3);
}

TEST(JacobiNewton, SmoothedLongEnoughIsTheUniformGrid) {
    EllipticSettings settings = newton_adaptation(0.0, 5000);
    settings.tolerance = 0.0;
    JacobiNewton solver(displaced_square_grid(25, 1.2), constant_weight(1.0), settings);
    EXPECT_EQ(solve(solver), SolverStatus::iteration_limit);
    const NodeArray uniform = square_grid(25);
    for (std::size_t k = 0; k < uniform.nodes.size(); ++k) {
        EXPECT_LT((solver.nodes().nodes[k] - uniform.nodes[k]).norm(), 2e-6);
    }
}

// T13.
TEST(JacobiNewton, NeedsOneIterationForW4OnAnySize) {
    for (const int n : {50, 70, 100, 150}) {
        JacobiNewton solver(square_grid(n), weight_w4(), newton_adaptation(1.0, 220));
        EXPECT_EQ(solve(solver), SolverStatus::converged);
        EXPECT_EQ(solver.iterations(), 1);
        EXPECT_NEAR(solver.norm(), 1.2335955e-4, 1e-8);
    }
}

TEST(JacobiNewton, LeavesAUniformGridAloneToTheBitWhenTheWeightIsConstant) {
    JacobiNewton solver(unit_spaced(12, 9), constant_weight(3.7), newton_adaptation(50.0, 220));
    EXPECT_EQ(solve(solver), SolverStatus::converged);
    EXPECT_EQ(solver.iterations(), 1);
    EXPECT_EQ(solver.norm(), 0.0);
    EXPECT_EQ(solver.nodes(), unit_spaced(12, 9));
}

// T15.
TEST(JacobiNewton, DoesNotMoveAFixedBoundaryByOneBit) {
    NodeArray start = displaced_square_grid(25, 0.4);
    start.at(0, 7) += Vec2(0.1234567, 0.0); // neither straight nor even
    JacobiNewton solver(start, weight_w1(), newton_adaptation(1.0, 100));
    solve(solver);
    EXPECT_NE(solver.nodes().at(12, 12), start.at(12, 12));
    for (int k = 0; k < 25; ++k) {
        EXPECT_EQ(solver.nodes().at(0, k), start.at(0, k));
        EXPECT_EQ(solver.nodes().at(24, k), start.at(24, k));
        EXPECT_EQ(solver.nodes().at(k, 0), start.at(k, 0));
        EXPECT_EQ(solver.nodes().at(k, 24), start.at(k, 24));
    }
}

TEST(JacobiNewton, SlidesTheBoundaryAlongItsSideInOrderAndKeepsTheCorners) {
    EllipticSettings settings = newton_adaptation(10.0, 5000);
    settings.boundary = Boundary::sliding;
    const NodeArray start = square_grid(25);
    JacobiNewton solver(start, weight_w3(24, 24), settings);
    ASSERT_EQ(solve(solver), SolverStatus::converged);
    const NodeArray& nodes = solver.nodes();
    for (const auto& [i, j] : std::array<std::array<int, 2>, 4>{{{0, 0}, {0, 24}, {24, 0}, {24, 24}}}) {
        EXPECT_EQ(nodes.at(i, j), start.at(i, j));
    }
    double moved = 0.0;
    for (int k = 1; k < 24; ++k) {
        EXPECT_EQ(nodes.at(0, k).x(), 0.0);
        EXPECT_EQ(nodes.at(24, k).x(), 24.0);
        EXPECT_EQ(nodes.at(k, 0).y(), 0.0);
        EXPECT_EQ(nodes.at(k, 24).y(), 24.0);
        EXPECT_GT(nodes.at(24, k).y(), nodes.at(24, k - 1).y());
        EXPECT_GT(nodes.at(k, 24).x(), nodes.at(k - 1, 24).x());
        moved = std::max(moved, std::abs(nodes.at(24, k).y() - k));
    }
    EXPECT_GT(moved, 0.2);
}

// T22.
TEST(JacobiNewton, IsTheSameAsTwoSweepsAnIterationToTheBit) {
    const EllipticSettings settings = newton_adaptation(5.0, 60);
    JacobiNewton solver(square_grid(25), weight_w1(), settings);
    solve(solver);

    const EquationRules rules{.functional = settings.functional};
    const WeightPtr w = weight_w1();
    NodeArray listed = square_grid(25);
    double norm = norm_at_start;
    int n = 0;
    while (n < settings.max_iterations && norm > settings.tolerance) {
        relax(listed, all_equations(listed, weight_at_nodes(*w, listed), rules), Boundary::fixed, 0.81);
        norm = residual_norm(all_equations(listed, weight_at_nodes(*w, listed), rules));
        ++n;
    }
    EXPECT_EQ(n, solver.iterations());
    EXPECT_EQ(norm, solver.norm());
    EXPECT_EQ(listed, solver.nodes());
}

// T21.
TEST(JacobiNewton, GivesTheSameBytesOnAnyNumberOfThreads) {
    EllipticSettings settings = newton_adaptation(5.0, 25);
    settings.boundary = Boundary::sliding;
    std::vector<NodeArray> found;
    for (const int threads : {1, 2, 7}) {
        set_thread_count(threads);
        JacobiNewton solver(unit_spaced(70, 50), weight_w1(), settings);
        solve(solver);
        found.push_back(solver.nodes());
    }
    set_thread_count(0);
    EXPECT_EQ(found[0], found[1]);
    EXPECT_EQ(found[0], found[2]);
}

// T14.
TEST(JacobiNewton, KeepsANodeWhoseSystemIsSingularAndSaysSo) {
    // On the uniform grid R_XX = -2 (2 + 2 w LV): zero for w LV = -1.
    JacobiNewton solver(square_grid(5), constant_weight(-1.0), newton_adaptation(1.0, 220));
    EXPECT_EQ(solve(solver), SolverStatus::singular);
    EXPECT_EQ(solver.nodes(), square_grid(5));
}

TEST(JacobiNewton, CallsAWeightThatIsNotFiniteByItsName) {
    JacobiNewton solver(square_grid(5), broken_weight(std::numeric_limits<double>::quiet_NaN()), {});
    EXPECT_EQ(solve(solver), SolverStatus::not_finite);
    EXPECT_EQ(solver.nodes(), square_grid(5));
}

TEST(JacobiNewton, ReportsAStartThatIsFoldedAlready) {
    NodeArray start = square_grid(7);
    start.at(3, 3) = Vec2(0.5, 0.5);
    JacobiNewton solver(start, constant_weight(1.0), {});
    EXPECT_EQ(solve(solver), SolverStatus::folded);
}

TEST(JacobiNewton, RefusesWhatItCannotSolve) {
    EXPECT_THROW(JacobiNewton(unit_spaced(2, 5), weight_w1(), {}), Defect);
    EXPECT_THROW(JacobiNewton(square_grid(5), nullptr, {}), Defect);
    NodeArray bent = square_grid(5);
    bent.at(0, 2).x() = 0.1;
    EllipticSettings sliding;
    sliding.boundary = Boundary::sliding;
    EXPECT_THROW(JacobiNewton(bent, weight_w1(), sliding), Defect);
    bent.at(2, 2).x() = std::numeric_limits<double>::infinity();
    EXPECT_THROW(JacobiNewton(bent, weight_w1(), {}), Defect);
}

TEST(JacobiNewton, ClonedGoesItsOwnWay) {
    JacobiNewton solver(square_grid(25), weight_w1(), newton_adaptation(1.0, 220));
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
