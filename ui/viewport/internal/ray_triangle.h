// Where a ray meets a triangle.
#pragma once

#include "core/geometry/vectors.h"

#include <cmath>
#include <optional>

namespace millwright::viewport {

/// Moeller and Trumbore 1997: (distance, weight of b, weight of c).
[[nodiscard]] inline std::optional<Vec3>
meet_triangle(const Vec3& origin, const Vec3& direction, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3 ab = b - a;
    const Vec3 ac = c - a;
    const Vec3 p = direction.cross(ac);
    const double volume = ab.dot(p);
    const Vec3 t = origin - a;
    const Vec3 q = t.cross(ab);
    const Vec3 met = Vec3(ac.dot(q), t.dot(p), direction.dot(q)) / volume;
    const bool inside = met.y() >= 0.0 && met.z() >= 0.0 && met.y() + met.z() <= 1.0;
    return std::abs(volume) > 0.0 && met.x() >= 0.0 && inside ? std::optional(met) : std::nullopt;
}

} // namespace millwright::viewport
