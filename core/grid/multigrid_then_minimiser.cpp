#include "core/grid/multigrid_then_minimiser.h"

#include "core/grid/discrete_minimiser.h"
#include "core/grid/multigrid.h"

#include <algorithm>
#include <utility>

namespace millwright::grid {

MultigridThenMinimiser::MultigridThenMinimiser(NodeArray start,
                                               WeightPtr weight,
                                               const EllipticSettings& settings)
    : weight_(weight), settings_(settings),
      solver_(std::make_unique<Multigrid>(std::move(start), std::move(weight), settings)) {}

MultigridThenMinimiser::MultigridThenMinimiser(const MultigridThenMinimiser& other,
                                               std::unique_ptr<EllipticSolver> solver)
    : EllipticSolver(other), weight_(other.weight_), settings_(other.settings_), solver_(std::move(solver)),
      last_norm_(other.last_norm_), iterations_before_(other.iterations_before_),
      fallen_back_(other.fallen_back_) {}

std::unique_ptr<EllipticSolver> MultigridThenMinimiser::clone() const {
    return std::unique_ptr<EllipticSolver>(new MultigridThenMinimiser(*this, solver_->clone()));
}

SolverStatus MultigridThenMinimiser::status() const {
    return solver_->status();
}

double MultigridThenMinimiser::norm() const {
    return solver_->iterations() > 0 ? solver_->norm() : last_norm_;
}

bool MultigridThenMinimiser::iterate() {
    solver_->iterate();
    const int left = settings_.max_iterations - iterations();
    if (!fallen_back_ && solver_->status() == SolverStatus::stalled && left > 0) {
        EllipticSettings rest = settings_;
        rest.max_iterations = left;
        last_norm_ = solver_->norm();
        iterations_before_ = solver_->iterations();
        solver_ = std::make_unique<DiscreteMinimiser>(solver_->nodes(), weight_, rest);
        fallen_back_ = true;
    }
    return solver_->status() == SolverStatus::running;
}

std::size_t MultigridThenMinimiser::memory_bytes(int rows, int columns) {
    return std::max(Multigrid::memory_bytes(rows, columns), DiscreteMinimiser::memory_bytes(rows, columns));
}

} // namespace millwright::grid
