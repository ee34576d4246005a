// A path in space as points for a table that takes one point a sampling period (decode.h).
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot/decode.h"

#include <optional>
#include <vector>

namespace millwright::plot {

/// At the path's own heights: cuts at the velocity along the path in space, up, down and travel at theirs.
/// Speeds and tool changes of the path do not count, nor do heights and end of the pen in the settings.
/// Begins above `start`, at the height of the path's first point. `fastest` as in decode_within(). Throws
/// Error as decode() and decode_within().
[[nodiscard]] std::vector<Vec3> decode_path(const CutPath& path,
                                            const DecodeSettings& settings,
                                            const std::optional<double>& fastest = std::nullopt,
                                            const Vec2& start = Vec2::Zero());

} // namespace millwright::plot
