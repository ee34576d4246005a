// The normal of a surface from its tangents, and where there is none.
#pragma once

#include "core/geometry/vectors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace millwright::geometry {

/// Below this a tangent of a patch inside `box` is as good as zero. It may be short, as beside a light
/// control point, and still be right.
inline double smallest_tangent(const Box3& box) {
    constexpr double rounding = 1e-13; // of one operation: 1e-16 of the coordinates
    const double farthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    return rounding * std::max(box.diagonal().norm(), farthest);
}

/// (du x dv) / |du x dv|; nothing where one of them is not above `smallest`, or where they are parallel.
inline std::optional<Vec3> unit_normal(double smallest, const Vec3& du, const Vec3& dv) {
    constexpr double parallel = 1e-12; // sine of the angle between them
    const Vec3 N = du.cross(dv);
    const double squared = N.squaredNorm();
    const double a = du.squaredNorm(), b = dv.squaredNorm();
    const bool long_enough = a > smallest * smallest && b > smallest * smallest;
    if (!(long_enough && squared > parallel * parallel * a * b)) {
        return std::nullopt;
    }
    return Vec3(N / std::sqrt(squared));
}

} // namespace millwright::geometry
