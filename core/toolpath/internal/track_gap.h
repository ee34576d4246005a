// How far apart neighbouring tracks are on the surface.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/grid/grid.h"

namespace millwright::toolpath {

/// The largest distance of a point of a track from its neighbour, mm. Parallel over tracks.
[[nodiscard]] double
largest_gap(const geometry::ParametricSurface& patch, const grid::Grid& grid, grid::TrackDirection direction);

} // namespace millwright::toolpath
