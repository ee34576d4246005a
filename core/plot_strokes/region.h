// Regions of the plane: what is filled, pocketed or must not be left. mm, or any one unit.
#pragma once

#include "core/geometry/vectors.h"

#include <vector>

namespace millwright::plot {

/// A closed line: its last point leads to its first.
using Ring = std::vector<Vec2>;

/// The points with an odd number of windings around them (even-odd rule), however the rings run or cross.
using Region = std::vector<Ring>;

/// Whether `point` is inside; on an edge either answer may come.
[[nodiscard]] bool contains(const Region& region, const Vec2& point);

} // namespace millwright::plot
