// The elementary angles atan 2^-s, 2^-s and atanh 2^-s, computed by the compiler in integers, correctly
// rounded to each number format: a mathematics library may differ in the last bit from one machine to the
// next.
#pragma once

#include "core/cordic/int128.h"
#include "core/cordic/sequence.h"

#include <array>
#include <cstdint>
#include <limits>

namespace millwright::cordic {

/// Binary places of the wide angles below; their error is under 2^-117.
inline constexpr int angle_places = 124;

/// atan (alternating) or atanh of 1/divisor by their power series, not above it: of an angle below 2^-s even
/// where nothing of the difference is left in so many places, or it would round as 2^-s does.
[[nodiscard]] constexpr Int128 inverse_tangent(Int128 divisor, bool alternating) {
    Int128 power = (Int128{1} << angle_places) / divisor;
    const Int128 square = divisor * divisor;
    Int128 sum = 0;
    for (int k = 1; power != 0; k += 2) {
        const Int128 term = power / k;
        sum += alternating && k % 4 == 3 ? -term : term;
        power /= square;
    }
    return alternating ? sum - 1 : sum;
}

/// pi/4 by Machin's formula.
[[nodiscard]] constexpr Int128 quarter_pi() {
    return 4 * inverse_tangent(5, true) - inverse_tangent(239, true);
}

using WideAngles = std::array<Int128, most_steps + 1>;

[[nodiscard]] constexpr WideAngles make_wide_angles(CoordinateSystem m) {
    WideAngles angles{};
    for (int s = 0; s <= most_steps; ++s) {
        Int128& angle = angles[static_cast<std::size_t>(s)];
        if (m == CoordinateSystem::linear) {
            angle = Int128{1} << (angle_places - s);
        } else if (s > 0) {
            angle = inverse_tangent(Int128{1} << s, m == CoordinateSystem::circular);
        } else if (m == CoordinateSystem::circular) {
            angle = quarter_pi();
        } // atanh 1 is infinite; no sequence has it
    }
    return angles;
}

inline constexpr WideAngles circular_angles = make_wide_angles(CoordinateSystem::circular);
inline constexpr WideAngles linear_angles = make_wide_angles(CoordinateSystem::linear);
inline constexpr WideAngles hyperbolic_angles = make_wide_angles(CoordinateSystem::hyperbolic);

/// The elementary angle of shift `s`, angle_places after the point.
[[nodiscard]] constexpr Int128 wide_angle(CoordinateSystem m, int s) {
    const auto at = static_cast<std::size_t>(s);
    if (m == CoordinateSystem::circular) {
        return circular_angles[at];
    }
    return m == CoordinateSystem::linear ? linear_angles[at] : hyperbolic_angles[at];
}

/// `wide` times 2^-places, rounded to the nearest integer, halves up. `places` is 1 to 126.
[[nodiscard]] constexpr Int128 nearest(Int128 wide, int places) {
    return ((wide >> (places - 1)) + 1) >> 1;
}

/// 2^exponent, exactly, within the normal numbers of T.
template <class T> [[nodiscard]] constexpr T power_of_two(int exponent) {
    T power = 1;
    const T factor = exponent < 0 ? T{1} / T{2} : T{2};
    for (int n = exponent < 0 ? -exponent : exponent; n > 0; --n) {
        power *= factor;
    }
    return power;
}

/// A number >= 0 with angle_places after the point, rounded to the nearest T.
template <class T> [[nodiscard]] constexpr T to_floating(Int128 wide) {
    constexpr int digits = std::numeric_limits<T>::digits;
    int bits = 0;
    while (bits < 127 && (wide >> bits) != 0) {
        ++bits;
    }
    const int dropped = bits - digits;
    const Int128 significand = dropped > 0 ? nearest(wide, dropped) : wide;
    return static_cast<T>(static_cast<std::int64_t>(significand)) *
           power_of_two<T>((dropped > 0 ? dropped : 0) - angle_places);
}

/// Binary places of inverse_gain.
inline constexpr int gain_places = 62;

/// 1/k of a sequence, gain_places after the point, rounded to the nearest: the largest r with r^2 k^2 <= 1,
/// bit by bit, and one more where r + 1/2 is not beyond either. k^2 is within 2^-113.
[[nodiscard]] constexpr std::int64_t inverse_gain(const Sequence& sequence) {
    constexpr int places = 120;
    Int128 k_squared = Int128{1} << places;
    for (int i = 0; i < sequence.step_count; ++i) {
        const int twice = 2 * sequence.shifts[static_cast<std::size_t>(i)];
        k_squared += sign_of(sequence.m) * (twice < places ? k_squared >> twice : 0);
    }
    const auto is_within = [&](UInt128 half_units) { // of r
        constexpr int one = 2 * (gain_places + 1) + places - 128;
        return product(half_units * half_units, static_cast<UInt128>(k_squared)) <=
               UInt256{UInt128{1} << one, 0};
    };
    std::uint64_t r = 0;
    for (int bit = gain_places; bit >= 0; --bit) { // r < 2
        const std::uint64_t tried = r + (std::uint64_t{1} << bit);
        r = is_within(UInt128{tried} * 2) ? tried : r;
    }
    return static_cast<std::int64_t>(r + (is_within(UInt128{r} * 2 + 1) ? 1 : 0));
}

} // namespace millwright::cordic
