#include "core/cordic/number_format.h"

#include "core/base/error.h"
#include "core/cordic/angles.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr int most_fraction_bits = 62; // angles are kept with 124 places and never round below that

constexpr std::array<std::pair<std::string_view, Rounding>, 4> roundings = {{
    {"truncate", Rounding::truncate},
    {"toward-zero", Rounding::toward_zero},
    {"nearest", Rounding::nearest},
    {"nearest-even", Rounding::nearest_even},
}};

/// Reads a count from the front of `text` and takes it away. False if there is none.
bool take_count(std::string_view& text, int& count) {
    const char* const end = text.data() + text.size();
    const auto [stop, fault] = std::from_chars(text.data(), end, count);
    if (fault != std::errc{} || text.front() == '-') {
        return false;
    }
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return true;
}

} // namespace

NumberFormat fixed_format(int integer_bits, int fraction_bits, Rounding rounding) {
    const bool bits = integer_bits >= 1 && integer_bits <= largest_word && fraction_bits >= 0 &&
                      fraction_bits <= most_fraction_bits;
    if (!bits || integer_bits + fraction_bits < least_word || integer_bits + fraction_bits > largest_word) {
        throw Error(fmt::format("the fixed-point format q{}.{} is not possible", integer_bits, fraction_bits),
                    {},
                    "use words of 8 to 64 bits, with at least the sign before the point and at most 62 bits "
                    "after it");
    }
    return {NumberKind::fixed, integer_bits, fraction_bits, rounding};
}

NumberFormat parse_number_format(std::string_view text) {
    if (text == "f64") {
        return binary64;
    }
    if (text == "f32") {
        return binary32;
    }
    std::string_view rest = text;
    int integer_bits = 0;
    int fraction_bits = 0;
    const bool begins = rest.starts_with('q') || rest.starts_with('Q');
    if (begins) {
        rest.remove_prefix(1);
    }
    if (begins && !rest.empty() && take_count(rest, integer_bits) && rest.starts_with('.')) {
        rest.remove_prefix(1);
        if (!rest.empty() && take_count(rest, fraction_bits) && rest.empty()) {
            return fixed_format(integer_bits, fraction_bits);
        }
    }
    throw Error(
        fmt::format("\"{}\" is not a number format", text), {}, "use f64, f32, or qI.F such as q2.22");
}

std::string to_text(const NumberFormat& format) {
    switch (format.kind) {
    case NumberKind::binary32:
        return "f32";
    case NumberKind::fixed:
        return fmt::format("q{}.{}", format.integer_bits, format.fraction_bits);
    case NumberKind::binary64:
        break;
    }
    return "f64";
}

Rounding parse_rounding(std::string_view text) {
    for (const auto& [name, rounding] : roundings) {
        if (name == text) {
            return rounding;
        }
    }
    throw Error(fmt::format("\"{}\" is not a rounding mode", text),
                {},
                "use truncate, toward-zero, nearest or nearest-even");
}

std::string_view to_text(Rounding rounding) {
    for (const auto& [name, known] : roundings) {
        if (known == rounding) {
            return name;
        }
    }
    return {};
}

double resolution(const NumberFormat& format) {
    if (format.kind == NumberKind::fixed) {
        return power_of_two<double>(-format.fraction_bits);
    }
    return power_of_two<double>(format.kind == NumberKind::binary64 ? -52 : -23);
}

} // namespace millwright::cordic
