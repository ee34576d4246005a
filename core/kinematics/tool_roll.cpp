#include "core/kinematics/tool_roll.h"

#include "core/base/units.h"

#include <cmath>

namespace millwright::kinematics {

namespace {

/// The base's -z after the shortest turn from the base's x to `axis`.
Vec3 x_without_roll(const Vec3& axis) {
    constexpr double backwards = 1e-12; // of 1 + axis.x(): about 1e-6 rad beside the base's -x
    const double ahead = 1.0 + axis.x();
    if (ahead < backwards) {
        return Vec3::UnitZ(); // as from above and from below, in the plane that arms reach over their back
                              // in
    }
    return Vec3(axis.z() / ahead * (Vec3::UnitX() + axis) - Vec3::UnitZ()).normalized();
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
    const double roll = std::atan2(rotation.col(0).dot(axis.cross(x0)), rotation.col(0).dot(x0));
    constexpr double rounding = 1e-9; // rad: half a turn is one number, not two in turns
    return roll <= rounding - pi ? roll + 2.0 * pi : roll;
}

} // namespace millwright::kinematics
