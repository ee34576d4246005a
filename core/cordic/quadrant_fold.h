// PreCORDIC and PostCORDIC (thesis section 3.4): any vector is folded into +-90 degrees by exact quarter
// turns, and unfolded after the iteration. And any angle is taken into +-45 degrees, which costs quarter
// turns of the vector.
#pragma once

#include "core/cordic/angles.h"
#include "core/cordic/arithmetic.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace millwright::cordic {

template <class Number> struct Folded {
    Number x{}, y{};
    bool f1 = false; ///< turned by -90 degrees, for y >= x
    bool f2 = false; ///< then by 180 degrees, for x < 0
};

/// PreCORDIC. The test is y >= x, not y >= |x|: the fold is not symmetric.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr Folded<Number> pre(const Arithmetic& arithmetic, Number x, Number y, bool& overflow) {
    Folded<Number> folded{.x = x, .y = y, .f1 = y >= x, .f2 = false};
    if (folded.f1) {
        folded.x = y;
        folded.y = arithmetic.negated(x, overflow);
    }
    folded.f2 = folded.x < Number{0};
    if (folded.f2) {
        folded.x = arithmetic.negated(folded.x, overflow);
        folded.y = arithmetic.negated(folded.y, overflow);
    }
    return folded;
}

/// PostCORDIC: undoes what pre did.
template <class Arithmetic, class Number = typename Arithmetic::Number>
[[nodiscard]] constexpr Folded<Number>
post(const Arithmetic& arithmetic, const Folded<Number>& folded, bool& overflow) {
    Folded<Number> v = folded;
    if (folded.f1) {
        v.x = arithmetic.negated(folded.y, overflow);
        v.y = folded.x;
    }
    if (folded.f2) {
        v.x = arithmetic.negated(v.x, overflow);
        v.y = arithmetic.negated(v.y, overflow);
    }
    return v;
}

/// The quarter turns that pre turned back: what post adds to the angle, -2 to 1.
template <class Number> [[nodiscard]] constexpr int quarter_turns_of(const Folded<Number>& folded) {
    if (folded.f1) {
        return folded.f2 ? -1 : 1;
    }
    return folded.f2 ? -2 : 0;
}

/// How far to shift (x, y) to the left (to the right if negative) so that vectoring has all digits of the
/// word and cannot overflow: a short vector in fixed point has a coarse direction otherwise. Floating point
/// needs that only where its parts would come near the numbers that have lost digits (subnormal ones).
template <class T>
[[nodiscard]] constexpr int normalising_shift(const FloatArithmetic<T>& /*format*/, T x, T y) {
    constexpr bool is_double = std::is_same_v<T, double>;
    constexpr T least = power_of_two<T>(is_double ? -900 : -70);
    const T size = std::max(x < T{0} ? -x : x, y < T{0} ? -y : y);
    return size < least && size > T{0} ? (is_double ? 200 : 100) : 0;
}
[[nodiscard]] constexpr int normalising_shift(const FixedArithmetic& format, std::int64_t x, std::int64_t y) {
    const auto bits = [](std::int64_t v) {
        return static_cast<int>(std::bit_width(static_cast<Word>(v < 0 ? ~v : v)));
    };
    const int used = std::max(bits(x), bits(y));
    const int room = bits(format.largest()) - 2; // gain and diagonal together stay below 4
    return used == 0 ? 0 : room - used;
}

template <class T>
[[nodiscard]] constexpr T normalised(const FloatArithmetic<T>& /*format*/, T value, int shift) {
    return value * power_of_two<T>(shift);
}
[[nodiscard]] constexpr std::int64_t
normalised(const FixedArithmetic& format, std::int64_t value, int shift) {
    return shift >= 0 ? static_cast<std::int64_t>(static_cast<Word>(value) << static_cast<unsigned>(shift))
                      : shifted_right(value, -shift, format.rounding());
}

/// The angle `quarter_turns` pi/2 + rest, |rest| about pi/4 at most.
template <class Number> struct ReducedAngle {
    std::int64_t quarter_turns = 0;
    Number rest{};
    bool too_large = false; ///< so many turns that the rest would have lost its digits; rest is then 0
};

/// More quarter turns than this are not reduced.
inline constexpr std::int64_t most_quarter_turns = std::int64_t{1} << 20;

/// pi/2 in two parts, so that a product of the first with a whole number below 2^20 is exact (Cody and Waite
/// 1980).
inline constexpr double half_pi_head = 0x1.921fb544p+0;
inline constexpr double half_pi_tail = 0x1.0b4611a626331p-34;

[[nodiscard]] constexpr ReducedAngle<double> reduced(const FloatArithmetic<double>& /*format*/, double z) {
    const double turns = z * 0x1.45f306dc9c883p-1; // 2/pi
    constexpr auto limit = static_cast<double>(most_quarter_turns);
    if (!(turns <= limit && turns >= -limit)) {
        return {.too_large = true};
    }
    const auto k = static_cast<std::int64_t>(turns < 0 ? turns - 0.5 : turns + 0.5);
    const auto n = static_cast<double>(k);
    return {.quarter_turns = k, .rest = (z - n * half_pi_head) - n * half_pi_tail};
}

[[nodiscard]] constexpr ReducedAngle<float> reduced(const FloatArithmetic<float>& /*format*/, float z) {
    const ReducedAngle<double> wide = reduced(FloatArithmetic<double>(), static_cast<double>(z));
    return {wide.quarter_turns, static_cast<float>(wide.rest), wide.too_large};
}

/// Exact but for one rounding of the rest: pi/2 has more places than the word by the width of k and more.
[[nodiscard]] constexpr ReducedAngle<std::int64_t> reduced(const FixedArithmetic& format, std::int64_t z) {
    const int places = angle_places - 2 - format.integer_bits();
    const int dropped = places - format.fraction_bits();
    const Int128 half_pi = nearest(quarter_pi(), angle_places - 1 - places);
    const Int128 wide = Int128{z} << dropped;
    const Int128 k = (wide < 0 ? wide - half_pi / 2 : wide + half_pi / 2) / half_pi;
    if (k > most_quarter_turns || k < -most_quarter_turns) {
        return {.too_large = true};
    }
    return {.quarter_turns = static_cast<std::int64_t>(k),
            .rest = static_cast<std::int64_t>(nearest(wide - k * half_pi, dropped))};
}

/// (x, y) turned by `count` quarter turns, exactly.
template <class Arithmetic, class Number = typename Arithmetic::Number>
constexpr void
quarter_turn(const Arithmetic& arithmetic, Number& x, Number& y, std::int64_t count, bool& overflow) {
    const auto quadrant = static_cast<int>(((count % 4) + 4) % 4);
    if (quadrant == 1 || quadrant == 3) {
        const Number old_x = x;
        x = arithmetic.negated(y, overflow);
        y = old_x;
    }
    if (quadrant >= 2) {
        x = arithmetic.negated(x, overflow);
        y = arithmetic.negated(y, overflow);
    }
}

} // namespace millwright::cordic
