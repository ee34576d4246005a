#include "core/base/text.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright {

std::string_view wide_encoding(std::string_view text) {
    using namespace std::string_view_literals;
    if (text.starts_with("\xFF\xFE\0\0"sv) || text.starts_with("\0\0\xFE\xFF"sv)) {
        return "UTF-32";
    }
    if (text.starts_with("\xFF\xFE"sv) || text.starts_with("\xFE\xFF"sv)) {
        return "UTF-16";
    }
    unsigned zeros = 0; // of the first four bytes, the first one highest
    for (std::size_t n = 0; n < 4; ++n) {
        zeros = 2 * zeros + (n < text.size() && text[n] == '\0' ? 1 : 0);
    }
    const bool four = text.size() >= 4;
    if (four && (zeros == 0b0111 || zeros == 0b1110)) {
        return "UTF-32";
    }
    return four && (zeros == 0b0101 || zeros == 0b1010) ? "UTF-16" : "";
}

std::string fixed(double value, int decimals) {
    expects(std::isfinite(value), "a number that becomes text is finite");
    std::string text = fmt::format("{:.{}f}", value, decimals);
    const bool negative_zero = text.front() == '-' && text.find_first_of("123456789") == std::string::npos;
    return negative_zero ? text.substr(1) : text;
}

std::string shortest(double value) {
    expects(std::isfinite(value), "a number that becomes text is finite");
    return fmt::format("{}", value);
}

std::string clock_time(double seconds) {
    expects(std::isfinite(seconds) && seconds >= 0.0, "a duration is finite and not negative");
    constexpr double last_bits = 1e-6; // of what was added up to whole seconds
    const auto whole = static_cast<long long>(std::ceil(std::max(0.0, seconds - last_bits)));
    constexpr long long minute = 60;
    constexpr long long hour = 3600;
    return fmt::format("{:02}:{:02}:{:02}", whole / hour, whole % hour / minute, whole % minute);
}

std::string short_time(double seconds) {
    constexpr double minute = 60.0;
    return seconds < minute ? fixed(seconds, 2) + " s" : clock_time(seconds);
}

} // namespace millwright
