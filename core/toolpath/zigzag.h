// The zigzag strategy: every node once, odd tracks backwards.
// Source: Parasilmongkol 1997, ch. 3.5 and listing (there: along v only).
#pragma once

#include "core/geometry/outline_tree.h"
#include "core/geometry/parametric_surface.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// Every node, those outside of `outline` (null: there are none) as point_to_trim() has them. The tool axis
/// is the surface normal, on the side of S_u x S_v, or the other one if `flipped`. Throws Error naming the
/// parameters where the normal is degenerate.
[[nodiscard]] Toolpath zigzag(const geometry::ParametricSurface& patch,
                              const grid::Grid& grid,
                              grid::TrackDirection direction,
                              bool flipped,
                              const geometry::OutlineTree* outline = nullptr);

} // namespace millwright::toolpath
