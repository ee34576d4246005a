// One rotation or one polar form in any number format, for every angle and every vector: what a person asks
// for by numbers, with the error against exact arithmetic.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/decimal.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <array>

namespace millwright::cordic {

/// Of words of more than 53 bits x, y and z are the nearest binary64; `words` has all bits.
struct Rotated {
    double x = 0.0, y = 0.0;
    double z = 0.0;     ///< angle that is left, rad
    double error = 0.0; ///< distance from the exactly rotated vector as it was given
    int clocks = 0;
    std::array<Word, 3> words{}; ///< x, y and z as the registers hold them
};

/// (x, y) turned counter-clockwise by any angle: quarter turns exactly, the rest by `sequence`, which is
/// circular. In fixed point the nearest numbers of the format to what is written are turned. Throws Error if
/// a value does not fit the format, or if all of the vector is 0 there and was not.
[[nodiscard]] Rotated rotate(const NumberFormat& format,
                             const Sequence& sequence,
                             const Decimal& x,
                             const Decimal& y,
                             const Decimal& angle_deg);

struct Polar {
    double length = 0.0;
    double angle_deg = 0.0; ///< -180 to 180
    double length_error = 0.0;
    double angle_error_deg = 0.0;
    int clocks = 0;
    int shift = 0;               ///< places that the vector was shifted to the left; < 0: right
    std::array<Word, 3> words{}; ///< the registers behind the pass: length, shifted so, rest of y, angle
};

/// Length and direction of (x, y). Throws Error for (0, 0), and for values as rotate().
[[nodiscard]] Polar
polar(const NumberFormat& format, const Sequence& sequence, const Decimal& x, const Decimal& y);

} // namespace millwright::cordic
