// Outlines in whole units, as an exact Voronoi diagram wants them: segments that neither cross nor overlap,
// and meet at their ends alone. Lengths mm where not named otherwise.
#pragma once

#include "core/base/progress.h"
#include "core/plot/carving/medial_axis.h"
#include "core/plot_strokes/region.h"

#include <array>
#include <cstdint>
#include <vector>

namespace millwright::plot::internal {

using UnitPoint = std::array<std::int32_t, 2>; ///< x, y in units

/// The inside lies at the left of the way from a to b.
struct OutlineSegment {
    UnitPoint a{};
    UnitPoint b{};
    int ring = 0; ///< of OutlineSegments::rings
};

struct OutlineSegments {
    Vec2 origin = Vec2::Zero(); ///< place of (0, 0)
    double unit = 0.0;
    Region rings; ///< around the inside: outer ones counter-clockwise, holes clockwise
    std::vector<OutlineSegment> segments;
    OutlineFindings crossings; ///< of the outlines as drawn, overlaps among them
    OutlineFindings flat;      ///< outlines that enclose no area
    OutlineFindings repeated;  ///< outlines that are drawn more than once

    [[nodiscard]] Vec2 place(const UnitPoint& point) const {
        return origin + unit * Vec2(point[0], point[1]);
    }
};

/// The rings by the even-odd rule, each drawn once. Places are rounded to a millionth of a millimetre, in
/// drawings of more than a metre to as little as 30 bits hold. Throws Error for what is not finite or farther
/// away than 1 km, for drawings too large for `tolerance`, and for more than a million segments; Cancelled.
[[nodiscard]] OutlineSegments
outline_segments(const Region& drawn, double tolerance, const Progress& progress = Progress());

} // namespace millwright::plot::internal
