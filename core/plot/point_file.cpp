#include "core/plot/point_file.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace millwright::plot {
namespace {

constexpr std::size_t most_diagnostics = 100;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> finite_number(std::string_view text) {
    text = trimmed(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<Vec3> point(std::string_view line) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) {
        const auto comma = line.find(',');
        if ((comma == std::string_view::npos) != (axis == 2)) {
            return std::nullopt;
        }
        const auto value = finite_number(line.substr(0, comma));
        if (!value) {
            return std::nullopt;
        }
        p[axis] = *value;
        line.remove_prefix(axis == 2 ? 0 : comma + 1);
    }
    return p;
}

} // namespace

std::string point_file_text(const std::vector<Vec3>& points, int decimals) {
    std::string text;
    for (const Vec3& p : points) {
        text += fixed(p.x(), decimals) + "," + fixed(p.y(), decimals) + "," + fixed(p.z(), decimals) + "\n";
    }
    return text;
}

PointFile read_points(std::string_view text, const std::filesystem::path& file) {
    PointFile read;
    refuse_wide_text(text, file);
    text = without_byte_order_mark(text);
    for (int finite_number = 1; !text.empty(); ++finite_number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty()) {
            continue;
        }
        if (const auto p = point(line)) {
            read.points.push_back(*p);
            read.lines.push_back(finite_number);
        } else if (read.diagnostics.size() < most_diagnostics) {
            constexpr std::size_t most_shown = 60;
            read.diagnostics.push_back(
                {.place = {.file = file, .line = finite_number},
                 .message = fmt::format("'{}' is no point", line.substr(0, most_shown)),
                 .hint = "three numbers with commas between: X, Y, Z"});
        }
    }
    return read;
}

bool is_point_file(std::string_view text) {
    text = without_byte_order_mark(text);
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    return point(trimmed(text.substr(0, text.find('\n')))).has_value();
}

} // namespace millwright::plot
