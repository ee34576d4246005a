#include "core/plot/picture/tool_tip.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::plot {
namespace {

constexpr double usual_v_diameter = 6.0;
constexpr double largest_diameter = 100.0;

std::vector<std::string_view> parts_of(std::string_view text) {
    std::vector<std::string_view> parts;
    while (true) {
        const auto colon = text.find(':');
        parts.push_back(text.substr(0, colon));
        if (colon == std::string_view::npos) {
            return parts;
        }
        text.remove_prefix(colon + 1);
    }
}

double positive_number(std::string_view part, double most, std::string_view whole) {
    double value = 0.0;
    const auto [end, fault] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (fault != std::errc() || end != part.data() + part.size() || !(value > 0.0 && value < most)) {
        throw Error(fmt::format("the tool '{}': '{}' is no number above 0 and below {}", whole, part, most));
    }
    return value;
}

} // namespace

double radius(const ToolTip& tip) {
    return tip.kind == TipKind::point ? 0.0 : tip.diameter / 2.0;
}

double rise(const ToolTip& tip, double distance) {
    constexpr double rim = 1e-9; // of the radius: sums of pixels miss it by rounding
    const double r = radius(tip);
    if (distance > r * (1.0 + rim)) {
        return std::numeric_limits<double>::infinity();
    }
    distance = std::min(distance, r);
    switch (tip.kind) {
    case TipKind::ball:
        return r - std::sqrt((r - distance) * (r + distance));
    case TipKind::v:
        return distance / std::tan(tip.angle / 2.0);
    case TipKind::point:
    case TipKind::flat:
        break;
    }
    return 0.0;
}

double rise_slope(const ToolTip& tip, double distance) {
    const double r = radius(tip);
    switch (tip.kind) {
    case TipKind::ball:
        return distance / std::sqrt((r - distance) * (r + distance));
    case TipKind::v:
        return 1.0 / std::tan(tip.angle / 2.0);
    case TipKind::point:
    case TipKind::flat:
        break;
    }
    return 0.0;
}

double mouth_radius(const ToolTip& tip, double depth) {
    const double r = radius(tip);
    switch (tip.kind) {
    case TipKind::ball:
        return depth < r ? std::sqrt(depth * (2.0 * r - depth)) : r;
    case TipKind::v:
        return std::min(r, depth * std::tan(tip.angle / 2.0));
    case TipKind::point:
    case TipKind::flat:
        break;
    }
    return r;
}

ToolTip parse_tool_tip(std::string_view text) {
    constexpr double straight = 180.0;
    const std::vector<std::string_view> parts = parts_of(text);
    ToolTip tip;
    if (parts[0] == "point" && parts.size() == 1) {
        tip.kind = TipKind::point;
        return tip;
    }
    if ((parts[0] == "ball" || parts[0] == "flat") && parts.size() == 2) {
        tip.kind = parts[0] == "ball" ? TipKind::ball : TipKind::flat;
        tip.diameter = positive_number(parts[1], largest_diameter, text);
        return tip;
    }
    if (parts[0] == "v" && (parts.size() == 2 || parts.size() == 3)) {
        tip.kind = TipKind::v;
        tip.angle = from_degrees(positive_number(parts[1], straight, text));
        tip.diameter =
            parts.size() == 3 ? positive_number(parts[2], largest_diameter, text) : usual_v_diameter;
        return tip;
    }
    throw Error(fmt::format("'{}' is no tool", text), {}, "ball:MM, flat:MM, v:DEGREES[:MM] or point");
}

std::string to_text(const ToolTip& tip) {
    switch (tip.kind) {
    case TipKind::ball:
        return "ball:" + shortest(tip.diameter);
    case TipKind::flat:
        return "flat:" + shortest(tip.diameter);
    case TipKind::v:
        return fmt::format("v:{}:{}", shortest(to_degrees(tip.angle)), shortest(tip.diameter));
    case TipKind::point:
        break;
    }
    return "point";
}

} // namespace millwright::plot
