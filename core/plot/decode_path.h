// A path in space as points for a table that takes one point a sampling period (decode.h).
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot/decode.h"

#include <optional>
#include <vector>

namespace millwright::plot {

struct DecodedPath {
    std::vector<Vec3> points;
    /// For each of them the point of the path that it leads to or is at, never falling; -1 on the way to the
    /// height of the first.
    std::vector<int> path_points;
};

/// At the path's own heights: cuts at the velocity along the path in space, up, down and travel at theirs.
/// Speeds of the path do not count, nor do heights and end of the pen in the settings. A tool change is no
/// point: whoever plays them stops there. Begins at `start` (not given: above zero, at the height of the
/// path's first point) and goes up or down to that height before it goes across. `fastest` as in
/// decode_within(). Throws Error as decode() and decode_within().
[[nodiscard]] DecodedPath decode_path(const CutPath& path,
                                      const DecodeSettings& settings,
                                      const std::optional<double>& fastest = std::nullopt,
                                      const std::optional<Vec3>& start = std::nullopt);

} // namespace millwright::plot
