// The roll of a tool about its axis, which is its z. Angles rad.
#pragma once

#include "core/geometry/vectors.h"

namespace millwright::kinematics {

/// The rotation of a tool along the unit vector `axis` with that roll. With roll 0 the tool's x lies in the
/// upright plane through the axis and points up; where the axis is upright, it is the base's x. A positive
/// roll turns it counterclockwise as seen against the axis.
[[nodiscard]] Mat3 frame_with_roll(const Vec3& axis, double roll);

/// The roll of a rotation, -pi to pi.
[[nodiscard]] double roll_of(const Mat3& rotation);

} // namespace millwright::kinematics
