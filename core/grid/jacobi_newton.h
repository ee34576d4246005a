// The reference solver: Jacobi iteration over the nodes, one Newton step of each node's own 2 x 2 system with
// its neighbours frozen, under-relaxed. Source: (Parasilmongkol 1997, KMITL) ch. 4 eqs 22 to 24 and appendix
// B; the residual of an iteration serves the next one, so that each costs one sweep instead of the listing's
// two.
#pragma once

#include "core/grid/grid_optimiser.h"

#include <cstddef>
#include <vector>

namespace millwright::grid {

/// Same bytes on any number of threads.
class JacobiNewton final : public EllipticSolver {
public:
    /// `start` is in solver coordinates, at least 3 x 3, finite; it may be folded and is then reported so by
    /// the first iteration. With a sliding boundary its outline is a rectangle along the axes. Throws Defect
    /// if not.
    JacobiNewton(NodeArray start, WeightPtr weight, const EllipticSettings& settings);

    bool iterate() override;

    [[nodiscard]] SolverStatus status() const override { return status_; }
    [[nodiscard]] int iterations() const override { return iterations_; }
    [[nodiscard]] double norm() const override { return norm_; }
    [[nodiscard]] const NodeArray& nodes() const override { return nodes_; }
    [[nodiscard]] std::unique_ptr<EllipticSolver> clone() const override;

    /// The equations at the current nodes, [rows x columns]. Zeros where a node does not move.
    [[nodiscard]] const std::vector<NodeEquations>& equations() const { return equations_; }

    /// What a solver for rows x columns nodes takes at most, bytes.
    [[nodiscard]] static std::size_t memory_bytes(int rows, int columns);

private:
    void sweep();
    [[nodiscard]] SolverStatus judge(bool singular) const;

    NodeArray nodes_;
    WeightPtr weight_;
    EllipticSettings settings_;
    std::vector<NodeEquations> equations_;
    SolverStatus status_ = SolverStatus::running;
    int iterations_ = 0;
    double norm_ = norm_at_start;
};

/// One update of the reference iteration on its own, also for nodes that have folded: every node that
/// `equations` speak of goes (1 - WW) of the way to its solution. Nodes without a solution stay; the count of
/// them is given.
int relax(NodeArray& nodes,
          const std::vector<NodeEquations>& equations,
          Boundary boundary,
          double relaxation);

} // namespace millwright::grid
