// The normal of a surface from its tangents, and where there is none.
#pragma once

#include "core/geometry/vectors.h"

#include <optional>

namespace millwright::geometry {

/// (du x dv) / |du x dv|; nothing where that is as good as zero for a patch inside `box`.
inline std::optional<Vec3> unit_normal(const Box3& box, const Vec3& du, const Vec3& dv) {
    constexpr double smallest = 1e-12; // |du x dv| against the patch's size squared: rounding alone is 1e-15
    const Vec3 N = du.cross(dv);
    const double length = N.norm();
    if (!(length > smallest * box.diagonal().squaredNorm())) {
        return std::nullopt;
    }
    return Vec3(N / length);
}

} // namespace millwright::geometry
