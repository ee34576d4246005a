// The vectors of the core. Points and directions in three dimensions (mm), parameters (u, v) in two.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace millwright {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// A rigid motion: `a_T_b` maps b-coordinates to a-coordinates.
using Frame = Eigen::Isometry3d;

/// An axis-aligned box; empty until extended.
using Box3 = Eigen::AlignedBox3d;

[[nodiscard]] inline bool is_finite(const Vec2& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y());
}
[[nodiscard]] inline bool is_finite(const Vec3& p) {
    return std::isfinite(p.x()) && std::isfinite(p.y()) && std::isfinite(p.z());
}

/// The z of the cross product of two directions in a plane.
[[nodiscard]] inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// The angle between two directions, rad in [0, pi], exact for nearly parallel ones too.
[[nodiscard]] inline double angle_between(const Vec3& a, const Vec3& b) {
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// A rotation that takes z to the unit vector `direction`; where x and y go is left open.
[[nodiscard]] inline Mat3 frame_along(const Vec3& direction) {
    const Vec3 x = direction.unitOrthogonal();
    Mat3 rotation;
    rotation << x, direction.cross(x), direction;
    return rotation;
}

} // namespace millwright
