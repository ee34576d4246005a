// Units at the border. Inside the core a bare name is mm, rad, s, mm/s; people see degrees and mm/min.
#pragma once

#include <numbers>

namespace millwright {

inline constexpr double pi = std::numbers::pi;

[[nodiscard]] constexpr double from_degrees(double deg) {
    return deg * (pi / 180.0);
}
[[nodiscard]] constexpr double to_degrees(double rad) {
    return rad * (180.0 / pi);
}
[[nodiscard]] constexpr double from_mm_per_min(double mm_per_min) {
    return mm_per_min / 60.0;
}
[[nodiscard]] constexpr double to_mm_per_min(double mm_per_s) {
    return mm_per_s * 60.0;
}

} // namespace millwright
