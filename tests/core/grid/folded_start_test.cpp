// Grids to start from whose cells have no area: every solver says so, and none makes a NaN of them.
#include "core/grid/discrete_minimiser.h"
#include "core/grid/jacobi_newton.h"
#include "core/grid/multigrid.h"
#include "tests/support/grid_arrays.h"
#include "tests/support/test_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

namespace millwright::grid {
namespace {

struct Start {
    std::string name;
    NodeArray nodes;
};

/// Of 9 x 9 nodes; the outline is sound in all but the last two.
std::vector<Start> degenerate_starts() {
    const NodeArray sound = square_grid(9);
    Start twice{"two nodes in one place", sound};
    twice.nodes.at(4, 4) = sound.at(4, 5);
    Start four{"the four nodes of a cell in one place", sound};
    four.nodes.at(4, 5) = four.nodes.at(5, 4) = four.nodes.at(5, 5) = sound.at(4, 4);
    Start flat{"two rows on one line", sound};
    Start over{"a row folded onto its line", sound};
    for (int j = 1; j < 8; ++j) {
        flat.nodes.at(4, j) = sound.at(5, j);
        over.nodes.at(4, j) = sound.at(4, 8 - j);
    }
    Start line{"all nodes on a slanted line", sound};
    Start point{"all nodes in one place", sound};
    for (std::size_t n = 0; n < sound.nodes.size(); ++n) {
        line.nodes.nodes[n] = (sound.nodes[n].x() + 0.1 * sound.nodes[n].y()) * Vec2(0.3, 0.7);
        point.nodes.nodes[n] = Vec2(0.5, 0.5);
    }
    return {twice, four, flat, over, line, point};
}

void expect_folded(EllipticSolver& solver, const Start& start) {
    EXPECT_FALSE(solver.iterate()) << start.name;
    EXPECT_EQ(solver.status(), SolverStatus::folded) << start.name;
    EXPECT_EQ(solver.nodes(), start.nodes) << start.name;
    EXPECT_TRUE(std::isfinite(solver.norm())) << start.name;
}

EllipticSettings adapted() {
    EllipticSettings settings;
    settings.functional.adaptation = 1.0;
    return settings;
}

// T14.
TEST(FoldedStart, WithoutAreaIsToldByEverySolver) {
    for (const Start& start : degenerate_starts()) {
        EllipticSettings settings = adapted();
        for (const auto derivatives : {WeightDerivatives::chain_rule, WeightDerivatives::listed}) {
            settings.derivatives = derivatives;
            JacobiNewton reference(start.nodes, weight_w1(), settings);
            expect_folded(reference, start);
        }
        Multigrid multigrid(start.nodes, weight_w1(), settings);
        expect_folded(multigrid, start);
        MultigridThenMinimiser both(start.nodes, weight_w1(), settings);
        expect_folded(both, start);
        DiscreteMinimiser minimiser(start.nodes, weight_w1(), settings);
        expect_folded(minimiser, start);
    }
}

TEST(FoldedStart, HardlyOpenGivesNoNaN) {
    NodeArray thin = square_grid(9);
    for (int j = 0; j < 9; ++j) {
        thin.at(4, j).x() = thin.at(5, j).x() - 1e-13;
    }
    JacobiNewton reference(thin, weight_w1(), adapted());
    Multigrid multigrid(thin, weight_w1(), adapted());
    DiscreteMinimiser minimiser(thin, weight_w1(), adapted());
    for (EllipticSolver* const solver :
         std::initializer_list<EllipticSolver*>{&reference, &multigrid, &minimiser}) {
        for (int n = 0; n < 50 && solver->iterate(); ++n) {
            EXPECT_TRUE(std::isfinite(solver->norm())) << n;
        }
        EXPECT_TRUE(all_finite(solver->nodes()));
    }
}

} // namespace
} // namespace millwright::grid
