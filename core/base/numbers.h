// Small questions about numbers.
#pragma once

#include <cmath>

namespace millwright {

/// a == b where exact equality is meant, not "nearly" (so that -Wfloat-equal keeps finding the accidents).
[[nodiscard]] constexpr bool exactly_equal(double a, double b) {
    return !(a < b) && !(a > b) && a - b <= 0.0;
}

[[nodiscard]] constexpr double square(double a) {
    return a * a;
}

/// The value between a and b at fraction t, exact at both ends.
[[nodiscard]] constexpr double mix(double a, double b, double t) {
    return (1.0 - t) * a + t * b;
}

} // namespace millwright
