// The operations an iteration is made of, one class a number format, all of the same shape. A result that the
// word cannot hold sets `overflow`, which nothing clears, and is the nearest number that it can hold (fixed
// point) or the largest finite one (floating point): nothing wraps silently, and no infinity or NaN comes out
// of finite numbers.
#pragma once

#include "core/cordic/angles.h"
#include "core/cordic/int128.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

namespace millwright::cordic {

/// A number as the registers hold it: its bits, sign-extended for fixed point.
using Word = std::uint64_t;

template <class T> class FloatArithmetic {
public:
    using Number = T;
    using Factor = T; ///< what `scaled` multiplies by
    using Bits = std::conditional_t<std::is_same_v<T, double>, std::uint64_t, std::uint32_t>;

    constexpr FloatArithmetic() {
        for (std::size_t s = 0; s < powers_.size(); ++s) {
            powers_[s] = power_of_two<T>(-static_cast<int>(s));
        }
    }

    /// value times 2^-shift, exactly (but for numbers at the edge of underflow).
    [[nodiscard]] constexpr T shifted(T value, int shift) const {
        return value * powers_[static_cast<std::size_t>(shift)];
    }
    [[nodiscard]] constexpr T sum(T a, T b, bool& overflow) const { return finite(a + b, overflow); }
    [[nodiscard]] constexpr T difference(T a, T b, bool& overflow) const { return finite(a - b, overflow); }
    [[nodiscard]] constexpr T negated(T value, bool& /*overflow*/) const { return -value; }
    /// A number with gain_places after the point as a factor.
    [[nodiscard]] constexpr Factor factor(std::int64_t number) const {
        return to_floating<T>(Int128{number} << (angle_places - gain_places));
    }
    [[nodiscard]] constexpr T scaled(T value, Factor factor, bool& overflow) const {
        return finite(value * factor, overflow);
    }
    [[nodiscard]] constexpr T angle(CoordinateSystem m, int s) const {
        return to_floating<T>(wide_angle(m, s));
    }

    [[nodiscard]] constexpr T from_double(double value, bool& overflow) const {
        if constexpr (std::is_same_v<T, double>) {
            return finite(value, overflow);
        } else {
            constexpr auto largest = static_cast<double>(std::numeric_limits<T>::max());
            if (!__builtin_isfinite(value) || !(value >= -largest && value <= largest)) {
                overflow = true;
                return __builtin_signbit(value) != 0 ? -std::numeric_limits<T>::max()
                                                     : std::numeric_limits<T>::max();
            }
            return static_cast<T>(value);
        }
    }
    [[nodiscard]] constexpr double to_double(T value) const { return static_cast<double>(value); }
    [[nodiscard]] constexpr Word to_word(T value) const { return std::bit_cast<Bits>(value); }
    /// Bits of no finite number set `overflow`. Seen by the bits: a signalling NaN may not even be loaded.
    [[nodiscard]] constexpr T from_word(Word word, bool& overflow) const {
        constexpr auto infinite = std::bit_cast<Bits>(std::numeric_limits<T>::infinity());
        const auto bits = static_cast<Bits>(word);
        if ((bits & infinite) != infinite) [[likely]] {
            return std::bit_cast<T>(bits);
        }
        overflow = true;
        constexpr T largest = std::numeric_limits<T>::max();
        return bits >> (8 * sizeof(Bits) - 1) != 0 ? -largest : largest;
    }
    [[nodiscard]] constexpr T from_word(Word word) const { return std::bit_cast<T>(static_cast<Bits>(word)); }

private:
    // The built-in functions are constexpr, and quiet where a comparison with a NaN would raise an exception.
    static constexpr T finite(T value, bool& overflow) {
        if (__builtin_isfinite(value)) [[likely]] {
            return value;
        }
        overflow = true;
        constexpr T largest = std::numeric_limits<T>::max();
        return __builtin_signbit(value) != 0 ? -largest : largest;
    }

    std::array<T, most_steps + 1> powers_{};
};

/// value times 2^-shift.
template <class Integer>
[[nodiscard]] constexpr Integer shifted_right(Integer value, int shift, Rounding rounding) {
    const Integer floor = value >> shift;
    if (rounding == Rounding::truncate || shift == 0) {
        return floor;
    }
    const Integer dropped = value - (floor << shift);
    const Integer half = Integer{1} << (shift - 1);
    switch (rounding) {
    case Rounding::toward_zero:
        return floor + (value < 0 && dropped != 0 ? 1 : 0);
    case Rounding::nearest:
        return floor + (dropped >= half ? 1 : 0);
    case Rounding::nearest_even:
        return floor + (dropped > half || (dropped == half && (floor & 1) != 0) ? 1 : 0);
    case Rounding::truncate:
        break;
    }
    return floor;
}

class FixedArithmetic {
public:
    using Number = std::int64_t;
    using Factor = std::int64_t;

    constexpr explicit FixedArithmetic(const NumberFormat& format)
        : integer_(format.integer_bits), fraction_(format.fraction_bits), rounding_(format.rounding),
          largest_(std::numeric_limits<Number>::max() >> (largest_word - format.word())) {}

    [[nodiscard]] constexpr Number shifted(Number value, int shift) const {
        return shifted_right(value, shift, rounding_);
    }
    [[nodiscard]] constexpr Number sum(Number a, Number b, bool& overflow) const {
        return narrowed(Int128{a} + b, overflow);
    }
    [[nodiscard]] constexpr Number difference(Number a, Number b, bool& overflow) const {
        return narrowed(Int128{a} - b, overflow);
    }
    [[nodiscard]] constexpr Number negated(Number value, bool& overflow) const {
        return narrowed(-Int128{value}, overflow);
    }
    [[nodiscard]] constexpr Factor factor(std::int64_t number) const { return number; }
    [[nodiscard]] constexpr Number scaled(Number value, Factor factor, bool& overflow) const {
        return narrowed(shifted_right(Int128{value} * factor, gain_places, rounding_), overflow);
    }
    [[nodiscard]] constexpr Number angle(CoordinateSystem m, int s) const {
        bool beyond = false; // a word too short for the angle has the nearest it can hold
        return narrowed(nearest(wide_angle(m, s), angle_places - fraction_), beyond);
    }

    /// The nearest number, halves to even.
    [[nodiscard]] constexpr Number from_double(double value, bool& overflow) const {
        const auto unit = power_of_two<double>(-fraction_);
        const double limit = -static_cast<double>(-largest_ - 1) * unit;
        const bool above = __builtin_isfinite(value) && (value >= -limit || value > -limit - unit);
        if (!above || !(value < limit)) {
            overflow = true;
            return __builtin_signbit(value) != 0 ? -largest_ - 1 : largest_;
        }
        const double scaled = value * power_of_two<double>(fraction_);
        auto whole = static_cast<Number>(scaled);
        const double rest = scaled - static_cast<double>(whole);
        if (rest > 0.5 || (rest >= 0.5 && (whole & 1) != 0)) {
            return narrowed(Int128{whole} + 1, overflow);
        }
        if (rest < -0.5 || (rest <= -0.5 && (whole & 1) != 0)) {
            return narrowed(Int128{whole} - 1, overflow);
        }
        return whole;
    }
    /// The nearest double; exact for words of up to 53 bits.
    [[nodiscard]] constexpr double to_double(Number value) const {
        return static_cast<double>(value) * power_of_two<double>(-fraction_);
    }
    [[nodiscard]] constexpr Word to_word(Number value) const { return static_cast<Word>(value); }
    [[nodiscard]] constexpr Number from_word(Word word, bool& overflow) const {
        return narrowed(static_cast<Number>(word), overflow);
    }
    [[nodiscard]] constexpr Number from_word(Word word) const { return static_cast<Number>(word); }

    /// The largest number of the word.
    [[nodiscard]] constexpr Number largest() const { return largest_; }
    [[nodiscard]] constexpr int integer_bits() const { return integer_; }
    [[nodiscard]] constexpr int fraction_bits() const { return fraction_; }
    [[nodiscard]] constexpr Rounding rounding() const { return rounding_; }

private:
    [[nodiscard]] constexpr Number narrowed(Int128 value, bool& overflow) const {
        if (value > largest_) [[unlikely]] {
            overflow = true;
            return largest_;
        }
        if (value < -largest_ - 1) [[unlikely]] {
            overflow = true;
            return -largest_ - 1;
        }
        return static_cast<Number>(value);
    }

    int integer_;
    int fraction_;
    Rounding rounding_;
    Number largest_;
};

/// Calls `use` with the arithmetic of a format known only at run time, and returns what it returns.
template <class Use> constexpr decltype(auto) with_arithmetic(const NumberFormat& format, Use&& use) {
    switch (format.kind) {
    case NumberKind::binary32:
        return use(FloatArithmetic<float>());
    case NumberKind::fixed:
        return use(FixedArithmetic(format));
    case NumberKind::binary64:
        break;
    }
    return use(FloatArithmetic<double>());
}

} // namespace millwright::cordic
