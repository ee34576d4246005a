// Strokes: what a pen draws between going down and going up. Lengths mm.
#pragma once

#include "core/geometry/vectors.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace millwright::plot {

/// One run of the pen. A stroke of a single point is a dot: the pen goes down and up there.
struct Stroke {
    int pen = 1;
    std::vector<Vec2> points; ///< at least one
    std::int64_t byte = -1;   ///< of the command that began it, in the file it was read from; -1: of none

    friend bool operator==(const Stroke&, const Stroke&) = default;
};

using Strokes = std::vector<Stroke>;

struct Extents {
    Vec2 lower = Vec2::Zero();
    Vec2 upper = Vec2::Zero();
};

/// The box around all points; nothing if there are none.
[[nodiscard]] std::optional<Extents> extents(const Strokes& strokes);

/// Length along the stroke, mm.
[[nodiscard]] double length(const Stroke& stroke);

/// Length of all strokes, mm.
[[nodiscard]] double draw_length(const Strokes& strokes);

/// Length of the straight travel with the pen up: from `start` to the first stroke, from the end of each to
/// the beginning of the next, and from the last to `end`; mm. Without strokes: from `start` to `end`.
[[nodiscard]] double air_length(const Strokes& strokes, const Vec2& start, const Vec2& end);

} // namespace millwright::plot
