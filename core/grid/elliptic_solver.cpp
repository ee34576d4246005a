#include "core/grid/elliptic_solver.h"

namespace millwright::grid {

SolverStatus solve(EllipticSolver& solver) {
    while (solver.iterate()) {
    }
    return solver.status();
}

} // namespace millwright::grid
