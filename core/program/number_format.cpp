#include "core/program/number_format.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <cmath>
#include <cstdlib>

namespace millwright::program {

double NumberFormat::digit() const {
    return std::pow(10.0, -decimals);
}

double NumberFormat::rounded(double value) const {
    return std::strtod(fixed(value, decimals).c_str(), nullptr);
}

std::string NumberFormat::text(double value) const {
    std::string text = fixed(value, decimals);
    if (!trailing_zeros && decimals > 0) {
        text.erase(text.find_last_not_of('0') + 1);
        if (!point && text.back() == '.') {
            text.pop_back();
        }
    } else if (decimals == 0 && point) {
        text += '.';
    }
    const bool negative = text.front() == '-';
    const std::size_t first = negative ? 1 : 0;
    const bool zero_before_digits = text.size() > first + 2 && text[first] == '0' && text[first + 1] == '.';
    if (!leading_zero && zero_before_digits) {
        text.erase(first, 1);
    }
    return plus && !negative ? "+" + text : text;
}

} // namespace millwright::program
