// The greatest numbers that files of machines and arms may hold: what is beyond them is a slip of the pen.
#pragma once

namespace millwright::kinematics {

inline constexpr double farthest_mm = 1e5;
inline constexpr double most_degrees = 36000.0;

} // namespace millwright::kinematics
