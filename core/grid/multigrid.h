// The fast solver: the equations of the grid functional by the full approximation scheme of multigrid
// methods (Brandt, Math. Comp. 31, 1977). An error that is smooth costs a pointwise iteration thousands of
// sweeps and a coarse level a few; so the work is proportional to the number of nodes.
#pragma once

#include "core/grid/grid_optimiser.h"

#include <cstddef>
#include <memory>

namespace millwright::grid {

class LevelStack;
class Recombination;

/// Solves what JacobiNewton solves, to the same norm; where the equations have one solution both find it. An
/// iteration is one V-cycle; the first one comes up from the coarsest level. No grid that it shows is folded
/// unless the start is. Where a weight is too strong for it, it says that it stalled. Same bytes on any
/// number of threads.
class Multigrid final : public EllipticSolver {
public:
    /// `start` is in solver coordinates, at least 3 x 3, finite; a folded one is reported by the first
    /// iteration. With a sliding boundary its outline is a rectangle along the axes. Throws Defect if not.
    /// Relaxation and weight derivatives of the settings are not used.
    Multigrid(NodeArray start, WeightPtr weight, const EllipticSettings& settings);
    Multigrid(const Multigrid& other);
    Multigrid(Multigrid&&) = delete;
    Multigrid& operator=(const Multigrid&) = delete;
    Multigrid& operator=(Multigrid&&) = delete;
    ~Multigrid() override;

    bool iterate() override;

    [[nodiscard]] SolverStatus status() const override { return status_; }
    [[nodiscard]] int iterations() const override { return iterations_; }
    [[nodiscard]] double norm() const override { return norm_; }
    [[nodiscard]] const NodeArray& nodes() const override;
    [[nodiscard]] std::unique_ptr<EllipticSolver> clone() const override;

    /// What a solver for rows x columns nodes takes at most, bytes.
    [[nodiscard]] static std::size_t memory_bytes(int rows, int columns);

private:
    [[nodiscard]] SolverStatus one_cycle();
    void recombine();

    std::unique_ptr<LevelStack> levels_;
    std::unique_ptr<Recombination> past_;
    EllipticSettings settings_;
    SolverStatus status_ = SolverStatus::running;
    int iterations_ = 0;
    double norm_ = norm_at_start;
    double best_norm_ = norm_at_start; ///< of the iterations that count as progress
    int last_progress_ = 0;            ///< the iteration of best_norm_
};

// The solver to take when nothing is known of a weight: Multigrid, and from its grid on DiscreteMinimiser
// where that does not get on. Never folds a cell.

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
