// The normal of a surface from its tangents, and where there is none.
#pragma once

#include "core/geometry/vectors.h"

#include <optional>

namespace millwright::geometry {

/// Below this |du x dv| is as good as zero for a patch inside `box`.
inline double smallest_normal(const Box3& box) {
    constexpr double smallest = 1e-12; // against the patch's size squared: rounding alone is 1e-15
    return smallest * box.diagonal().squaredNorm();
}

/// (du x dv) / |du x dv|; nothing where its length is not above `smallest`.
inline std::optional<Vec3> unit_normal(double smallest, const Vec3& du, const Vec3& dv) {
    const Vec3 N = du.cross(dv);
    const double length = N.norm();
    if (!(length > smallest)) {
        return std::nullopt;
    }
    return Vec3(N / length);
}

} // namespace millwright::geometry
