// How far one node goes to where its own equations hold, its neighbours frozen.
#pragma once

#include "core/grid/elliptic_solver.h"

namespace millwright::grid {

struct Displacement {
    Vec2 step = Vec2::Zero();
    bool singular = false; ///< the 2 x 2 system has no solution: no step
};

/// `share` of the way for node (i, j), which may go where `boundary` lets it; a node on a side goes at most
/// so far that two neighbours there cannot meet.
[[nodiscard]] Displacement
displacement(const NodeArray& nodes, const NodeEquations& e, int i, int j, Boundary boundary, double share);

} // namespace millwright::grid
