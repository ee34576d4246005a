#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright {

namespace {

constexpr std::size_t looked_at = 4096; // bytes

/// How many of the bytes at `first`, `first` + `step`, ... are zero.
std::size_t zeros_at(std::string_view bytes, std::size_t first, std::size_t step) {
    std::size_t zeros = 0;
    for (std::size_t n = first; n < bytes.size(); n += step) {
        zeros += bytes[n] == '\0' ? 1 : 0;
    }
    return zeros;
}

/// Other scripts have no zero byte, so that a quarter of the letters may lack it.
bool mostly(std::size_t zeros, std::size_t letters) {
    return 4 * zeros >= 3 * letters;
}

} // namespace

std::string_view wide_encoding(std::string_view bytes) {
    using namespace std::string_view_literals;
    if (bytes.starts_with("\xFF\xFE\0\0"sv) || bytes.starts_with("\0\0\xFE\xFF"sv)) {
        return "UTF-32";
    }
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) {
        return "UTF-16";
    }
    bytes = bytes.substr(0, std::min(bytes.size(), looked_at) / 4 * 4);
    const std::size_t quarter = bytes.size() / 4;
    if (quarter == 0) {
        return {};
    }
    std::array<std::size_t, 4> zeros{};
    for (std::size_t n = 0; n < zeros.size(); ++n) {
        zeros[n] = zeros_at(bytes, n, zeros.size());
    }
    const auto& [a, b, c, d] = zeros;
    if ((a == 0 && mostly(b, quarter) && c == quarter && d == quarter) ||
        (a == quarter && b == quarter && mostly(c, quarter) && d == 0)) {
        return "UTF-32";
    }
    const std::size_t half = 2 * quarter;
    return (a + c == 0 && mostly(b + d, half)) || (mostly(a + c, half) && b + d == 0) ? "UTF-16" : "";
}

std::optional<Diagnostic> wide_text_fault(std::string_view bytes, const std::filesystem::path& file) {
    const std::string_view encoding = wide_encoding(bytes);
    if (encoding.empty()) {
        return std::nullopt;
    }
    return Diagnostic{.place = {.file = file, .line = 1},
                      .message = fmt::format("the file is text in {}", encoding),
                      .hint = "save it as ASCII or UTF-8"};
}

void refuse_wide_text(std::string_view bytes, const std::filesystem::path& file) {
    if (auto fault = wide_text_fault(bytes, file)) {
        throw Error(std::move(*fault));
    }
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
