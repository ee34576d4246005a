// Small questions about numbers.
#pragma once

#include <cmath>
#include <limits>
#include <string_view>

namespace millwright {

inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// a == b where exact equality is meant, not "nearly" (so that -Wfloat-equal keeps finding the accidents).
[[nodiscard]] constexpr bool exactly_equal(double a, double b) {
    return !(a < b) && !(a > b) && a - b <= 0.0;
}

[[nodiscard]] constexpr double square(double a) {
    return a * a;
}

[[nodiscard]] constexpr bool lies_between(double value, double least, double most) {
    return value >= least && value <= most;
}

/// The value between a and b at fraction t, exact at both ends.
[[nodiscard]] constexpr double mix(double a, double b, double t) {
    return (1.0 - t) * a + t * b;
}

/// The text of a number without the plus in front of it, which people may write and std::from_chars refuses.
[[nodiscard]] constexpr std::string_view without_plus(std::string_view text) {
    const bool plus = text.starts_with('+') && !text.starts_with("+-");
    return text.substr(plus ? 1 : 0);
}

} // namespace millwright
