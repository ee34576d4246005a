// Angles that the tests of the processor calculate with.
#pragma once

#include <numbers>

namespace millwright::cordic {

inline constexpr double pi = std::numbers::pi;
inline constexpr double degree = pi / 180.0;

} // namespace millwright::cordic
