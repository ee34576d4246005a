// The fast solver: the equations of the grid functional by the full approximation scheme of multigrid
// methods (Brandt, Math. Comp. 31, 1977). An error that is smooth costs a pointwise iteration thousands of
// sweeps and a coarse level a few; so the work is proportional to the number of nodes.
#pragma once

#include "core/grid/elliptic_solver.h"

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

} // namespace millwright::grid
