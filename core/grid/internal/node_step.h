// How far one node goes to where its own equations hold, its neighbours frozen.
#pragma once

#include "core/grid/elliptic_equations.h"
#include "core/grid/grid_optimiser.h"

#include <array>

namespace millwright::grid {

// The nodes that the equations of one node speak of, and those equations when the nodes' indices stand any
// distance apart: coarse levels of a multigrid method have the indices of the finest one.

/// A node and its eight neighbours, [a][b] being node (i + a - 1, j + b - 1), with the weights that are used.
struct NodeStencil {
    std::array<std::array<Vec2, 3>, 3> p;
    double w = 0.0;
    double w_before = 0.0, w_after = 0.0; ///< at (i - 1, j) and (i + 1, j)
    double w_below = 0.0, w_above = 0.0;  ///< at (i, j - 1) and (i, j + 1)
};

/// One over the distance of neighbours in xi and eta, counted in nodes of the finest level: 1 there.
struct IndexDensity {
    double xi = 1.0, eta = 1.0;
};

/// As node_equations() of an array, with the slope of the weight by the chain rule.
[[nodiscard]] NodeEquations
node_equations(const NodeStencil& at, const FunctionalWeights& lambda, const IndexDensity& density);

struct Displacement {
    Vec2 step = Vec2::Zero();
    bool singular = false; ///< the 2 x 2 system has no solution: no step
};

/// `share` of the way for node (i, j), which may go where `boundary` lets it; a node on a side goes at most
/// so far that two neighbours there cannot meet.
[[nodiscard]] Displacement
displacement(const NodeArray& nodes, const NodeEquations& e, int i, int j, Boundary boundary, double share);

} // namespace millwright::grid
