// The zigzag strategy: every node once, odd tracks backwards.
// Source: Parasilmongkol 1997, ch. 3.5 and listing (there: along v only).
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

/// The tool axis is the surface normal, on the side of S_u x S_v, or the other one if `flipped`.
/// Throws Error naming the parameters where the normal is degenerate.
[[nodiscard]] Toolpath zigzag(const geometry::BezierPatch& patch,
                              const grid::Grid& grid,
                              grid::TrackDirection direction,
                              bool flipped);

} // namespace millwright::toolpath
