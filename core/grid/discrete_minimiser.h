// The robust solver: minimises a functional over the corners of the cells (corner_functionals.h) by
// L-BFGS. A step that would close a corner triangle is shortened, so no iteration ever folds a cell, however
// strong the weight.
#pragma once

#include "core/grid/corner_functionals.h"
#include "core/grid/descent.h"
#include "core/grid/grid_optimiser.h"

#include <cstddef>
#include <functional>

namespace millwright::grid {

/// What is minimised: infinite where a corner is not positive.
using GridFunctional = std::function<DiscreteFunctional(const NodeArray& nodes)>;

/// Same bytes on any number of threads. The norm is max (|g_x| + |g_y|) / 4 over the nodes that may move, g
/// the gradient: what JacobiNewton calls the norm, since g is about -2 R.
class DiscreteMinimiser final : public EllipticSolver {
public:
    /// `start` is in solver coordinates, at least 2 x 2, finite; a folded one is reported by the first
    /// iteration. With a sliding boundary its outline is a rectangle along the axes. Throws Defect if not.
    DiscreteMinimiser(NodeArray start, GridFunctional functional, const EllipticSettings& settings);
    /// Of discrete_functional() with `weight` and the weights in `settings`.
    DiscreteMinimiser(NodeArray start, WeightPtr weight, const EllipticSettings& settings);

    bool iterate() override;

    [[nodiscard]] SolverStatus status() const override { return status_; }
    [[nodiscard]] int iterations() const override { return iterations_; }
    [[nodiscard]] double norm() const override { return norm_; }
    [[nodiscard]] const NodeArray& nodes() const override { return nodes_; }
    [[nodiscard]] std::unique_ptr<EllipticSolver> clone() const override;

    /// The functional at the current nodes.
    [[nodiscard]] double value() const { return now_.value; }

    /// What a solver for rows x columns nodes takes at most, bytes.
    [[nodiscard]] static std::size_t memory_bytes(int rows, int columns);

private:
    [[nodiscard]] DiscreteFunctional evaluate(const NodeArray& nodes) const;
    bool search(const std::vector<Vec2>& direction);
    void remember(const NodeArray& old_nodes, const DiscreteFunctional& old);

    NodeArray nodes_;
    GridFunctional functional_;
    EllipticSettings settings_;
    DiscreteFunctional now_;
    DescentMemory memory_;
    SolverStatus status_ = SolverStatus::running;
    int iterations_ = 0;
    double norm_ = norm_at_start;
};

} // namespace millwright::grid
