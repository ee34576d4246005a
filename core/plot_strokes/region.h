// Regions of the plane: what is filled, pocketed or must not be left. mm, or any one unit.
#pragma once

#include "core/geometry/vectors.h"
#include "core/plot_strokes/strokes.h"

#include <vector>

namespace millwright::plot {

/// A closed line: its last point leads to its first.
using Ring = std::vector<Vec2>;

/// The points with an odd number of windings around them (even-odd rule), however the rings run or cross.
using Region = std::vector<Ring>;

/// Whether `point` is inside; on an edge either answer may come.
[[nodiscard]] bool contains(const Region& region, const Vec2& point);

// Hatching: a region filled with parallel lines.

struct HatchSettings {
    double pitch = 1.5875;      ///< between lines, > 0; 1/16 inch as in the KMITL thesis of 2006
    double angle = 0.0;         ///< of the lines to x, counter-clockwise, rad
    bool cross = false;         ///< and once more at right angles
    Vec2 origin = Vec2::Zero(); ///< a line goes through here
};

/// How many lines cross the region's box, without `cross`: what `hatch` would cost. May be huge, is never
/// NaN.
[[nodiscard]] double line_count(const Region& region, const HatchSettings& settings);

/// The lines inside the region, from below to above across the lines' direction, every other one backwards,
/// as strokes of `pen`. Throws Error if the pitch is not above 0 or anything is not finite.
[[nodiscard]] Strokes hatch(const Region& region, const HatchSettings& settings, int pen = 1);

} // namespace millwright::plot
