// How a control wants numbers written.
#pragma once

#include <string>

namespace millwright::program {

struct NumberFormat {
    int decimals = 4;           ///< 0 to 6
    bool plus = false;          ///< + before what is not negative
    bool leading_zero = true;   ///< 0.5, not .5
    bool trailing_zeros = true; ///< 1.500, not 1.5
    bool point = true;          ///< also behind whole numbers: 1., not 1

    /// The value of the last digit.
    [[nodiscard]] double digit() const;
    /// `value` at the nearest number that can be written; a zero is not negative. Throws Defect if `value` is
    /// not finite.
    [[nodiscard]] double rounded(double value) const;
    /// The text of rounded(value).
    [[nodiscard]] std::string text(double value) const;

    friend bool operator==(const NumberFormat&, const NumberFormat&) = default;
};

} // namespace millwright::program
