// Numbers that a person enters as numbers of a format, refused where the format cannot hold them, and results
// with all of their digits.
#pragma once

#include "core/base/error.h"
#include "core/cordic/arithmetic.h"
#include "core/cordic/decimal.h"
#include "core/cordic/number_format.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <type_traits>

namespace millwright::cordic::internal {

/// Throws Error if a value of the iteration did not fit.
inline void refuse_overflow(bool overflow, const NumberFormat& format, const char* room) {
    if (overflow) {
        throw Error(fmt::format("the result or an intermediate value does not fit into {}", to_text(format)),
                    {},
                    room);
    }
}

template <class Arithmetic>
typename Arithmetic::Number
entered(const Arithmetic& arithmetic, const NumberFormat& format, const Decimal& value) {
    bool overflow = false;
    typename Arithmetic::Number number{};
    if constexpr (std::is_same_v<Arithmetic, FixedArithmetic>) {
        number = value.to_fixed(format, overflow);
    } else {
        number = arithmetic.from_double(value.nearest_double(), overflow);
    }
    if (overflow) {
        throw Error(fmt::format("{} does not fit into {}", value.nearest_double(), to_text(format)));
    }
    return number;
}

/// A vector that the format takes for nothing is not turned in silence; one part of it may vanish.
inline void refuse_vanished(const NumberFormat& format, const Decimal& x, const Decimal& y, bool is_held) {
    const long double wanted_x = x.nearest_long_double();
    const long double wanted_y = y.nearest_long_double();
    if (!is_held && (std::abs(wanted_x) > 0.0L || std::abs(wanted_y) > 0.0L)) {
        throw Error(
            fmt::format("({:g}, {:g}) is below the resolution of {}", wanted_x, wanted_y, to_text(format)),
            {},
            "choose a number format with more fraction bits");
    }
}

/// With all bits of a fixed-point word.
template <class Arithmetic>
long double exactly(const Arithmetic& arithmetic, typename Arithmetic::Number number) {
    if constexpr (std::is_same_v<Arithmetic, FixedArithmetic>) {
        return std::ldexp(static_cast<long double>(number), -arithmetic.fraction_bits());
    } else {
        return static_cast<long double>(number);
    }
}

template <class Arithmetic, class Vector>
std::array<Word, 3>
words_of_vector(const Arithmetic& arithmetic, const NumberFormat& format, const Vector& v) {
    const auto word = [&](auto number) { return lowest_bits(arithmetic.to_word(number), format.word()); };
    return {word(v.x), word(v.y), word(v.z)};
}

} // namespace millwright::cordic::internal
