#include "core/kinematics/tool_roll.h"

#include <cmath>

namespace millwright::kinematics {

namespace {

Vec3 x_without_roll(const Vec3& axis) {
    constexpr double upright = 1e-9; // horizontal part of the axis
    const bool is_upright = std::hypot(axis.x(), axis.y()) < upright;
    const Vec3 towards = is_upright ? Vec3::UnitX() : Vec3::UnitZ();
    return (towards - axis.dot(towards) * axis).normalized();
}

} // namespace

Mat3 frame_with_roll(const Vec3& axis, double roll) {
    const Vec3 x0 = x_without_roll(axis);
    const Vec3 x = std::cos(roll) * x0 + std::sin(roll) * axis.cross(x0);
    Mat3 rotation;
    rotation << x, axis.cross(x), axis;
    return rotation;
}

double roll_of(const Mat3& rotation) {
    const Vec3 axis = rotation.col(2), x0 = x_without_roll(axis);
    return std::atan2(rotation.col(0).dot(axis.cross(x0)), rotation.col(0).dot(x0));
}

} // namespace millwright::kinematics
