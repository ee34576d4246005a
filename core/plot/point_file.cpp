#include "core/plot/point_file.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::plot {

namespace {

constexpr std::size_t most_diagnostics = 100;

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r";
    const auto first = text.find_first_not_of(blanks);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// `comma`: it is the decimal point.
std::optional<double> finite_number(std::string_view field, bool comma) {
    std::string text(trimmed(field));
    if (comma) {
        std::ranges::replace(text, ',', '.');
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Where a line has semicolons or tabs, these separate, and a number may have a decimal comma.
char separator_in(std::string_view line) {
    return line.find(';') != std::string_view::npos    ? ';'
           : line.find('\t') != std::string_view::npos ? '\t'
                                                       : ',';
}

/// Three, or nothing.
std::optional<std::array<std::string_view, 3>> fields_of(std::string_view line) {
    const char separator = separator_in(line);
    std::array<std::string_view, 3> fields;
    for (std::size_t n = 0; n < fields.size(); ++n) {
        const auto end = line.find(separator);
        if ((end == std::string_view::npos) != (n == 2)) {
            return std::nullopt;
        }
        fields[n] = line.substr(0, end);
        line.remove_prefix(n == 2 ? 0 : end + 1);
    }
    return fields;
}

std::optional<Vec3> point(std::string_view line) {
    const auto fields = fields_of(line);
    Vec3 p;
    for (std::size_t n = 0; fields && n < fields->size(); ++n) {
        const auto value = finite_number((*fields)[n], separator_in(line) != ',');
        if (!value) {
            return std::nullopt;
        }
        p[static_cast<Eigen::Index>(n)] = *value;
    }
    return fields ? std::optional(p) : std::nullopt;
}

/// `X,Y,Z`, `x (mm); y (mm); z (mm)`, `"X","Y","Z"`: the names of the columns.
bool names_columns(std::string_view line) {
    const auto fields = fields_of(line);
    for (std::size_t n = 0; fields && n < fields->size(); ++n) {
        const std::string_view name = (*fields)[n];
        const auto first = name.find_first_not_of(" \t#\"'");
        const bool is_axis =
            first != std::string_view::npos && (name[first] | ' ') == "xyz"[n] &&
            (first + 1 == name.size() || std::isalpha(static_cast<unsigned char>(name[first + 1])) == 0);
        if (!is_axis) {
            return false;
        }
    }
    return fields.has_value();
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
    if (auto fault = wide_text_fault(text, file)) {
        read.diagnostics.push_back(std::move(*fault));
        return read;
    }
    text = without_byte_order_mark(text);
    bool first = true;
    for (int number = 1; !text.empty(); ++number) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || (std::exchange(first, false) && names_columns(line))) {
            continue;
        }
        if (const auto p = point(line)) {
            read.points.push_back(*p);
            read.lines.push_back(number);
        } else if (read.diagnostics.size() < most_diagnostics) {
            constexpr std::size_t most_shown = 60;
            read.diagnostics.push_back(
                {.place = {.file = file, .line = number},
                 .message = fmt::format("'{}' is not a point", line.substr(0, most_shown)),
                 .hint = "write three numbers separated by commas or semicolons: X, Y, Z"});
        }
    }
    return read;
}

bool is_point_file(std::string_view text) {
    text = without_byte_order_mark(text);
    const auto take_line = [&text] {
        text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
        const std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(line.size());
        return trimmed(line);
    };
    const std::string_view first = take_line();
    return point(names_columns(first) ? take_line() : first).has_value();
}

namespace {

/// The height up to which points are in the work.
double top_of(const std::vector<Vec3>& points) {
    const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& point) { return point.z(); });
    constexpr double last_digit = 1e-9;
    return std::max(lowest->z(), 0.0) + last_digit;
}

CutMove move_between(const Vec3& from, const Vec3& to, double top) {
    const bool begins = from.z() <= top;
    const bool ends = to.z() <= top;
    if (!ends) {
        return begins ? CutMove::retract : CutMove::rapid;
    }
    if (!(to - from).head<2>().isZero(0.0)) {
        return CutMove::cut;
    }
    return to.z() < from.z() ? CutMove::plunge : CutMove::retract;
}

} // namespace

CutPath path_of_points(const std::vector<Vec3>& points, const PointPathSettings& settings) {
    CutPath path;
    if (points.empty()) {
        return path;
    }
    const double top = top_of(points);
    const auto above = [&](const Vec3& point) {
        return Vec3(point.x(), point.y(), std::max(point.z(), settings.safe_height));
    };
    const auto speed_of = [&](CutMove move) {
        return move == CutMove::cut ? settings.cutting : move == CutMove::plunge ? settings.plunging : 0.0;
    };
    Vec3 at = above(points.front());
    path.push_back({.at = at, .speed = 0.0, .move = CutMove::rapid, .tool = 1});
    for (const Vec3& point : points) {
        if (point != at) {
            const CutMove move = move_between(at, point, top);
            path.push_back({.at = point, .speed = speed_of(move), .move = move, .tool = 1});
            at = point;
        }
    }
    if (at.z() < settings.safe_height) {
        path.push_back({.at = above(at), .speed = 0.0, .move = CutMove::retract, .tool = 1});
    }
    return path;
}

Strokes strokes_of_points(const std::vector<Vec3>& points) {
    Strokes strokes;
    bool down = false;
    const CutPath path = path_of_points(points);
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec2 from = path[n - 1].at.head<2>();
        const Vec2 to = path[n].at.head<2>();
        const bool cuts = path[n].move == CutMove::cut && to != from;
        if (cuts && !down) {
            strokes.push_back({.pen = 1, .points = {from}});
        }
        if (cuts) {
            strokes.back().points.push_back(to);
        }
        down = cuts;
    }
    return strokes;
}

} // namespace millwright::plot
