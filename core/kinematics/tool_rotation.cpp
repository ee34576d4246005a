#include "core/kinematics/tool_rotation.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <Eigen/LU>
#include <Eigen/SVD>
#include <fmt/format.h>

#include <algorithm>
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

namespace {

constexpr double roundness = 1e-3; // by which typed numbers may be off
constexpr const char* hint_of_rows = "give the matrix row by row: r11 r12 r13 r21 r22 r23 r31 r32 r33";

} // namespace

Mat3 rotation_of_rows(std::span<const double> rows) {
    constexpr std::size_t count = 9;
    if (rows.size() != count) {
        throw Error(
            fmt::format("a rotation matrix has 9 numbers, but {} were given", rows.size()), {}, hint_of_rows);
    }
    if (!std::ranges::all_of(rows, [](double value) { return std::isfinite(value); })) {
        throw Error("the rotation matrix is not finite", {}, hint_of_rows);
    }
    Mat3 given;
    given << rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8];
    for (int n = 0; n < 3; ++n) {
        const double length = given.col(n).norm();
        if (!(std::abs(length - 1.0) <= roundness)) {
            throw Error(
                fmt::format("column {} of the rotation matrix has length {:.6g}, not 1", n + 1, length),
                {},
                hint_of_rows);
        }
        const int next = (n + 1) % 3;
        const double cosine = given.col(n).dot(given.col(next));
        if (!(std::abs(cosine) <= roundness)) {
            throw Error(fmt::format("columns {} and {} of the rotation matrix are not perpendicular: their "
                                    "product is {:.6g}, not 0",
                                    std::min(n, next) + 1,
                                    std::max(n, next) + 1,
                                    cosine),
                        {},
                        hint_of_rows);
        }
    }
    if (given.determinant() < 0.0) {
        throw Error("the rotation matrix is left-handed: its determinant is -1", {}, hint_of_rows);
    }
    const Eigen::JacobiSVD<Mat3> parts(given, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return parts.matrixU() * parts.matrixV().transpose();
}

} // namespace millwright::kinematics
