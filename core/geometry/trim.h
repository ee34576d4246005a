// The part of a patch that a trimmed face has, as closed loops in the parameters of the patch.
#pragma once

#include "core/geometry/vectors.h"

#include <optional>
#include <vector>

namespace millwright::geometry {

/// Closed polygons over [0,1]^2 without their first corner again. What an odd number of them goes around
/// belongs to the face; a loop inside another one is a hole. Without loops: the whole patch.
struct Trim {
    using Loop = std::vector<Vec2>; ///< at least 3 corners
    std::vector<Loop> loops;

    [[nodiscard]] bool everything() const { return loops.empty(); }
    /// Of a place on the border of the patch: whether what is next to it inside of the patch belongs to it.
    [[nodiscard]] bool contains(const Vec2& uv) const;

    friend bool operator==(const Trim&, const Trim&) = default;
};

inline constexpr int most_trim_loops = 1'000;
inline constexpr int most_trim_corners = 100'000; ///< of all loops

/// A part of a straight way, as shares of it: 0 is its start, 1 its end.
struct WayPart {
    double from = 0.0;
    double to = 1.0;
};

/// The parts of the straight way from `a` to `b` in the parameters that lie inside, in their order. Parts
/// shorter than a millionth of the way are left out.
[[nodiscard]] std::vector<WayPart> parts_inside(const Trim& trim, const Vec2& a, const Vec2& b);

/// What `loops` leave of the square of side 1 whose lowest corner is `corner`, in that square's own
/// parameters: everything, a part, or nothing at all.
[[nodiscard]] std::optional<Trim> trim_in_square(const std::vector<Trim::Loop>& loops, const Vec2& corner);

} // namespace millwright::geometry
