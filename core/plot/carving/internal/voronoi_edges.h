// The edges of the Voronoi diagram of outlines that lie inside of them, as curves. Home of Boost.Polygon.
// Lengths mm where not named otherwise.
#pragma once

#include "core/base/progress.h"
#include "core/plot/carving/internal/outline_segments.h"

#include <vector>

namespace millwright::plot::internal {

struct VoronoiEdge {
    int from = 0; ///< vertex
    int to = 0;
    int ring = 0;          ///< one that it is nearest to, of OutlineSegments::rings
    int other_ring = 0;    ///< another, or the same
    std::vector<Vec3> way; ///< x, y, clearance; 0 of it at the outline
};

/// Edges between places that are equally near to two segments, or an end of one: those between a segment and
/// its own end are left out. Chords miss place and clearance by no more than `sampling`. Vertices are
/// numbered from 0 in the order in which edges reach them. Throws Cancelled.
[[nodiscard]] std::vector<VoronoiEdge>
voronoi_edges(const OutlineSegments& outlines, double sampling, const Progress& progress);

} // namespace millwright::plot::internal
