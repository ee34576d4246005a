#include "core/grid/grid_optimiser.h"

namespace millwright::grid {

OptimiserState run(GridOptimiser& optimiser, const Progress& progress) {
    while (optimiser.advance(progress)) {
        progress.check();
    }
    return optimiser.state();
}

SolverStatus solve(EllipticSolver& solver) {
    while (solver.iterate()) {
    }
    return solver.status();
}

} // namespace millwright::grid
