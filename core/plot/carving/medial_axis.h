// The medial axis of a region: the places that are equally near to two or more places of its outline, with
// their clearance, the radius of the largest disc there that stays inside. Lengths mm. Computed as part of
// the Voronoi diagram of the outline's segments (Boost.Polygon, exact predicates). Source of the idea: H.
// Blum, "A transformation for extracting new descriptors of shape", 1967.
#pragma once

#include "core/base/progress.h"
#include "core/plot_strokes/region.h"

#include <cstddef>
#include <vector>

namespace millwright::plot {

struct AxisSettings {
    double sampling = 0.0025; ///< curves are chords that miss place and clearance by no more, > 0
    /// Branches go where the discs that are left miss what they reached by no more, >= 0: those of the
    /// corners between chords of a curve.
    double pruning = 0.0025;

    friend bool operator==(const AxisSettings&, const AxisSettings&) = default;
};

struct AxisNode {
    Vec2 at = Vec2::Zero();
    double clearance = 0.0; ///< 0 at the corners of the outline
    int part = 0;           ///< of the region, which may be in several, from 0
};

struct AxisEdge {
    int from = 0; ///< node
    int to = 0;
    std::vector<Vec3> way; ///< x, y, clearance, from `from` to `to`
};

/// How often something was found among the outlines as drawn, and where first.
struct OutlineFindings {
    std::size_t count = 0;
    Vec2 first = Vec2::Zero();
};

struct MedialAxis {
    Region region;               ///< without crossings: outer rings counter-clockwise, holes clockwise
    std::vector<int> ring_parts; ///< part of each ring
    int parts = 0;
    std::vector<AxisNode> nodes; ///< one without an edge is a disc, or what pruning has left of it
    std::vector<AxisEdge> edges;
    OutlineFindings crossings; ///< of the outlines as drawn, overlaps among them
    OutlineFindings flat;      ///< outlines that enclose no area
    OutlineFindings repeated;  ///< outlines that are drawn more than once, and count once
};

/// By the even-odd rule. Of outlines that enclose nothing, an axis without parts. Throws Error for settings
/// out of their range, for what is not finite or farther away than 1 km, for a region too large for the
/// tolerances, and for more than a million segments; Cancelled, which within the diagram itself takes about a
/// second for 100,000 segments.
[[nodiscard]] MedialAxis
medial_axis(const Region& drawn, const AxisSettings& settings = {}, const Progress& progress = Progress());

} // namespace millwright::plot
