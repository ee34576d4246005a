// The roll of a tool about its axis, which is its z. Angles rad.
#pragma once

#include "core/geometry/vectors.h"

namespace millwright::kinematics {

/// The rotation of a tool along the unit vector `axis` with that roll. It is counted from where the shortest
/// turn from the base's x to the axis takes the base's -z: x of a tool that points up, down of a level one,
/// -x of one that points down. No rule is without a jump everywhere; this one has it where the tool points
/// exactly back (-x, level) and nowhere else. A positive roll turns the tool counterclockwise as seen against
/// the axis.
[[nodiscard]] Mat3 frame_with_roll(const Vec3& axis, double roll);

/// The roll of a rotation, above -pi, up to pi.
[[nodiscard]] double roll_of(const Mat3& rotation);

} // namespace millwright::kinematics
