// The energy of a harmonic map (Winslow 1967; Dvinsky 1991) under the metric M = diag(m^2, 1), m along the
// tracks: over the corners of the cells (x_xi' M x_xi + x_eta' M x_eta) / (sqrt(det M) J). Where m is large,
// nodes of one track come close together, and tracks stay where they are as far as they can. With one m for
// both directions nothing would move, for in the plane the energy does not know the scale of a metric.
#pragma once

#include "core/grid/discrete_functional.h"
#include "core/grid/grid.h"

namespace millwright::grid {

/// As discrete_functional(); `m` is positive. Parallel over rows, same bytes on any number of threads. Throws
/// Error if `m` does.
[[nodiscard]] DiscreteFunctional
harmonic_functional(const NodeArray& nodes, const Weight& m, TrackDirection direction);

} // namespace millwright::grid
