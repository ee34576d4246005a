// Where segments in whole units cross, overlap or touch. Exact: products of differences fit 64 bits.
#pragma once

#include "core/base/progress.h"
#include "core/plot/carving/internal/outline_segments.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace millwright::plot::internal {

/// Above 0 where the way from a over b to c turns left, 0 where it is straight: twice the area of the
/// triangle, square units.
[[nodiscard]] inline std::int64_t turn(const UnitPoint& a, const UnitPoint& b, const UnitPoint& c) {
    const auto from_a = [&](const UnitPoint& p, std::size_t axis) {
        return std::int64_t{p[axis]} - std::int64_t{a[axis]};
    };
    return from_a(b, 0) * from_a(c, 1) - from_a(b, 1) * from_a(c, 0);
}

struct UnitCrossings {
    std::size_t crossing = 0;    ///< pairs that cross in the middle of both
    std::size_t overlapping = 0; ///< pairs that have a length in common
    Vec2 first = Vec2::Zero();   ///< place of the first pair, units
};

/// Throws Cancelled.
[[nodiscard]] UnitCrossings crossings_of(const std::vector<OutlineSegment>& segments,
                                         const Progress& progress);

/// Segments that touch another in its middle split it there. Throws Cancelled.
[[nodiscard]] std::vector<OutlineSegment> split_at_touches(const std::vector<OutlineSegment>& segments,
                                                           const Progress& progress);

/// Without what runs there and back again: the inside is on both of its sides. What runs twice the same way
/// stays once.
[[nodiscard]] std::vector<OutlineSegment> without_shared_sides(std::vector<OutlineSegment> segments);

} // namespace millwright::plot::internal
