#include "core/pmac/driver/internal/card_numbers.h"

#include <charconv>
#include <cmath>
#include <cstdint>

namespace millwright::pmac::internal {

std::optional<double> card_number(std::string_view text) {
    const char* const end = text.data() + text.size();
    if (text.starts_with('$')) {
        constexpr int hexadecimal = 16;
        std::uint32_t bits = 0;
        const auto read = std::from_chars(text.data() + 1, end, bits, hexadecimal);
        return read.ec == std::errc{} && read.ptr == end ? std::optional<double>(bits) : std::nullopt;
    }
    double value = 0.0;
    const auto read = std::from_chars(text.data(), end, value);
    const bool whole = read.ec == std::errc{} && read.ptr == end;
    return whole && std::isfinite(value) && std::abs(value) < 1e12 ? std::optional(value) : std::nullopt;
}

} // namespace millwright::pmac::internal
