// The directions of a tool as nine numbers, r11 r12 r13 r21 ... r33: the rotation matrix of Saengsasri,
// Nittayachin 1996, KMITL, section 1, row by row. Its columns are the tool's x, y and z in the arm's base.
#pragma once

#include "core/geometry/vectors.h"

#include <span>

namespace millwright::kinematics {

// The roll of a tool about its axis, which is its z. Angles rad.

/// The rotation of a tool along the unit vector `axis` with that roll. It is counted from where the shortest
/// turn from the base's x to the axis takes the base's -z: x of a tool that points up, down of a level one,
/// -x of one that points down. No rule is without a jump everywhere; this one has it where the tool points
/// exactly back (-x, level) and nowhere else. A positive roll turns the tool counterclockwise as seen against
/// the axis.
[[nodiscard]] Mat3 frame_with_roll(const Vec3& axis, double roll);

/// The roll of a rotation, above -pi, up to pi.
[[nodiscard]] double roll_of(const Mat3& rotation);

/// The rotation nearest to nine typed numbers, whose rounding is taken away. Throws Error with the column or
/// the pair of columns where they are no rotation: not nine finite numbers, a length other than 1, no right
/// angle (more than a thousandth off), left-handed.
[[nodiscard]] Mat3 rotation_of_rows(std::span<const double> rows);

} // namespace millwright::kinematics
