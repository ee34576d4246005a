// The solver to take when nothing is known of a weight: Multigrid, and from its grid on DiscreteMinimiser
// where that does not get on. Never folds a cell.
#pragma once

#include "core/grid/elliptic_solver.h"

#include <cstddef>
#include <memory>

namespace millwright::grid {

/// Iterations are counted through. Norm and settings as those of the solver that is at work; the minimiser
/// has the iterations that are left. Same bytes on any number of threads.
class MultigridThenMinimiser final : public EllipticSolver {
public:
    /// As Multigrid.
    MultigridThenMinimiser(NodeArray start, WeightPtr weight, const EllipticSettings& settings);

    bool iterate() override;

    [[nodiscard]] SolverStatus status() const override;
    [[nodiscard]] int iterations() const override { return iterations_before_ + solver_->iterations(); }
    [[nodiscard]] double norm() const override;
    [[nodiscard]] const NodeArray& nodes() const override { return solver_->nodes(); }
    [[nodiscard]] std::unique_ptr<EllipticSolver> clone() const override;

    /// Whether the minimiser is at work.
    [[nodiscard]] bool has_fallen_back() const { return fallen_back_; }

    /// What a solver for rows x columns nodes takes at most, bytes.
    [[nodiscard]] static std::size_t memory_bytes(int rows, int columns);

private:
    MultigridThenMinimiser(const MultigridThenMinimiser& other, std::unique_ptr<EllipticSolver> solver);

    WeightPtr weight_;
    EllipticSettings settings_;
    std::unique_ptr<EllipticSolver> solver_;
    double last_norm_ = norm_at_start; ///< of the solver before
    int iterations_before_ = 0;        ///< of the solver before
    bool fallen_back_ = false;
};

} // namespace millwright::grid
