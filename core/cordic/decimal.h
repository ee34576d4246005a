// A number as a person writes it, with all of its digits: binary64 would cut those that words of more than 53
// bits can hold.
#pragma once

#include "core/cordic/int128.h"
#include "core/cordic/number_format.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace millwright::cordic {

class Decimal {
public:
    /// The digits of `value`, all of them. Throws Error unless it is finite.
    Decimal(double value); // NOLINT(google-explicit-constructor): nothing is lost
    /// A decimal number with sign, point and exponent as one likes. Throws Error that quotes the text unless
    /// all of it is a number within the range of binary64.
    [[nodiscard]] static Decimal parse(std::string_view text);

    [[nodiscard]] double nearest_double() const { return nearest_; }
    [[nodiscard]] long double nearest_long_double() const;
    /// The nearest number of fixed-point `format`, halves to even. `overflow` is set if it does not fit.
    [[nodiscard]] std::int64_t to_fixed(const NumberFormat& format, bool& overflow) const;

    /// Degrees as quarter turns, modulo 4, and a rest within 45 degrees.
    struct Turn {
        int quarter_turns = 0;
        Int128 rest = 0; ///< rad, angle_places after the point; its error is under 2^-67
    };
    [[nodiscard]] Turn as_degrees() const;

private:
    Decimal() = default;
    /// From digits with at most one point.
    void set_digits(std::string_view digits, std::int64_t exponent);

    std::string whole_;    ///< digits before the point
    std::string fraction_; ///< and behind it
    bool negative_ = false;
    double nearest_ = 0.0;
};

} // namespace millwright::cordic
