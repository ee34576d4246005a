// The directions of a tool as nine numbers, r11 r12 r13 r21 ... r33: the rotation matrix of Saengsasri,
// Nittayachin 1996, KMITL, section 1, row by row. Its columns are the tool's x, y and z in the arm's base.
#pragma once

#include "core/geometry/vectors.h"

#include <span>

namespace millwright::kinematics {

/// The rotation nearest to nine typed numbers, whose rounding is taken away. Throws Error with the column or
/// the pair of columns where they are no rotation: not nine finite numbers, a length other than 1, no right
/// angle (more than a thousandth off), left-handed.
[[nodiscard]] Mat3 rotation_of_rows(std::span<const double> rows);

} // namespace millwright::kinematics
