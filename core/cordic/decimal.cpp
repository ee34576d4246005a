#include "core/cordic/decimal.h"

#include "core/base/error.h"
#include "core/cordic/angles.h"
#include "core/cordic/line_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace millwright::cordic {
namespace {

constexpr int most_places = 1074; // of a binary64 behind the point, and more than any exponent of one

/// Takes the next binary place from decimal digits behind the point, which become twice as much less it.
int take_bit(std::string& fraction) {
    int carry = 0;
    for (auto digit = fraction.rbegin(); digit != fraction.rend(); ++digit) {
        const int twice = 2 * (*digit - '0') + carry;
        carry = twice >= 10 ? 1 : 0;
        *digit = static_cast<char>('0' + twice - 10 * carry);
    }
    return carry;
}

/// The first `count` binary places.
Int128 take_bits(std::string& fraction, int count) {
    Int128 bits = 0;
    for (int n = 0; n < count; ++n) {
        bits = (bits << 1) + take_bit(fraction);
    }
    return bits;
}

bool is_zero(std::string_view digits) {
    return digits.find_first_not_of("0.") == std::string_view::npos;
}

int modulo(std::string_view digits, int divisor) {
    int rest = 0;
    for (const char digit : digits) {
        rest = (10 * rest + (digit - '0')) % divisor;
    }
    return rest;
}

} // namespace

Decimal::Decimal(double value) : negative_(std::signbit(value)), nearest_(value) {
    if (!std::isfinite(value)) {
        throw Error("the number is not finite");
    }
    set_digits(fmt::format("{:.{}f}", std::abs(value), most_places), 0);
}

Decimal Decimal::parse(std::string_view text) {
    Decimal number;
    if (!read_real(text, number.nearest_)) {
        throw Error(fmt::format("\"{}\" is not a number", text),
                    {},
                    "write a number such as 1.5, -2 or 3e-4, within the range of binary64");
    }
    number.negative_ = text.front() == '-';
    const std::string_view digits = text.substr(text.front() == '-' || text.front() == '+' ? 1 : 0);
    const std::size_t e = std::min(digits.find_first_of("eE"), digits.size());
    std::int64_t exponent = 0;
    if (e < digits.size()) {
        const std::string_view written = digits.substr(e + (digits[e + 1] == '+' ? 2 : 1));
        std::from_chars(written.data(), written.data() + written.size(), exponent);
    }
    number.set_digits(digits.substr(0, e), is_zero(digits.substr(0, e)) ? 0 : exponent);
    return number;
}

void Decimal::set_digits(std::string_view digits, std::int64_t exponent) {
    const std::size_t point = std::min(digits.find('.'), digits.size());
    whole_ = digits.substr(0, point);
    fraction_ = point < digits.size() ? digits.substr(point + 1) : std::string_view();
    for (; exponent > 0; --exponent) {
        whole_ += fraction_.empty() ? '0' : fraction_.front();
        fraction_.erase(0, fraction_.empty() ? 0 : 1);
    }
    for (; exponent < 0; ++exponent) {
        fraction_.insert(fraction_.begin(), whole_.empty() ? '0' : whole_.back());
        whole_.erase(whole_.empty() ? 0 : whole_.size() - 1);
    }
    fraction_.erase(fraction_.find_last_not_of('0') + 1);
    whole_.erase(0, std::min(whole_.find_first_not_of('0'), whole_.size()));
}

long double Decimal::nearest_long_double() const {
    const std::string text = whole_ + "." + fraction_ + "0";
    const long double size = std::strtold(text.c_str(), nullptr);
    return negative_ ? -size : size;
}

std::int64_t Decimal::to_fixed(const NumberFormat& format, bool& overflow) const {
    const Int128 beyond = Int128{1} << (format.word() - 1);
    Int128 size = 0;
    for (const char digit : whole_) {
        size = std::min(10 * size + (digit - '0'), 2 * beyond); // too large stays too large
    }
    std::string fraction = fraction_;
    size = (size << format.fraction_bits) + take_bits(fraction, format.fraction_bits);
    const bool half = take_bit(fraction) == 1;
    size += half && (!is_zero(fraction) || (size & 1) != 0) ? 1 : 0;
    const Int128 most = negative_ ? beyond : beyond - 1;
    overflow = overflow || size > most;
    size = std::min(size, most);
    return static_cast<std::int64_t>(negative_ ? -size : size);
}

Decimal::Turn Decimal::as_degrees() const {
    constexpr int degree_places = 69; // a product with 63 binary places of a fraction fits 127 bits
    constexpr Int128 degree = quarter_pi() / 45;
    constexpr int fraction_places = 63;
    const int degrees = modulo(whole_, 360);
    int quarters = (degrees + 45) / 90;
    int rest = degrees - 90 * quarters; // -45 to 44
    std::string fraction = fraction_;
    const Int128 part = take_bits(fraction, fraction_places);
    const Int128 size = rest * degree + ((part * (degree >> (angle_places - degree_places))) >>
                                         (degree_places + fraction_places - angle_places));
    quarters = negative_ ? -quarters : quarters;
    return {(quarters % 4 + 4) % 4, negative_ ? -size : size};
}

} // namespace millwright::cordic
