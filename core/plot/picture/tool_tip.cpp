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
        throw Error(fmt::format("tool '{}': '{}' is not a number above 0 and below {}", whole, part, most));
    }
    return value;
}

/// Of a V with a round end: where the rounding passes into the cone, seen from its begin beside the axis.
struct Rounding {
    double distance = 0.0;
    double height = 0.0;
};

Rounding rounding_of(const ToolTip& tip) {
    const double half = tip.angle / 2.0;
    return {tip.end_radius * std::cos(half), tip.end_radius * (1.0 - std::sin(half))};
}

double rise_of_v(const ToolTip& tip, double distance) {
    const double beside = std::max(0.0, distance - tip.end_width / 2.0);
    const auto [end, height] = rounding_of(tip);
    if (beside < end) {
        return tip.end_radius - std::sqrt((tip.end_radius - beside) * (tip.end_radius + beside));
    }
    return height + (beside - end) / std::tan(tip.angle / 2.0);
}

double slope_of_v(const ToolTip& tip, double distance) {
    const double beside = distance - tip.end_width / 2.0;
    if (beside < 0.0) {
        return 0.0;
    }
    if (beside < rounding_of(tip).distance) {
        return beside / std::sqrt((tip.end_radius - beside) * (tip.end_radius + beside));
    }
    return 1.0 / std::tan(tip.angle / 2.0);
}

double mouth_of_v(const ToolTip& tip, double depth) {
    const auto [end, height] = rounding_of(tip);
    const double beside = depth < height ? std::sqrt(depth * (2.0 * tip.end_radius - depth))
                                         : end + (depth - height) * std::tan(tip.angle / 2.0);
    return tip.end_width / 2.0 + beside;
}

std::string end_text(const ToolTip& tip) {
    return tip.end_radius > 0.0  ? ":r" + shortest(tip.end_radius)
           : tip.end_width > 0.0 ? ":" + shortest(tip.end_width)
                                 : "";
}

/// `0.2`: flat and so wide; `r0.1`: round.
void read_end(std::string_view part, std::string_view whole, ToolTip& tip) {
    const bool round = part.starts_with('r');
    (round ? tip.end_radius : tip.end_width) =
        positive_number(round ? part.substr(1) : part, largest_diameter, whole);
    const double wide = tip.end_width + 2.0 * rounding_of(tip).distance;
    if (!(wide < tip.diameter)) {
        throw Error(fmt::format(
            "tool '{}': its end of {} mm is as wide as the tool or wider", whole, shortest(wide)));
    }
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
        return rise_of_v(tip, distance);
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
        return slope_of_v(tip, distance);
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
        return std::min(r, mouth_of_v(tip, depth));
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
    if (parts[0] == "v" && parts.size() >= 2 && parts.size() <= 4) {
        tip.kind = TipKind::v;
        tip.angle = from_degrees(positive_number(parts[1], straight, text));
        tip.diameter =
            parts.size() > 2 ? positive_number(parts[2], largest_diameter, text) : usual_v_diameter;
        if (parts.size() == 4) {
            read_end(parts[3], text, tip);
        }
        return tip;
    }
    throw Error(
        fmt::format("'{}' is not a tool", text), {}, "use ball:MM, flat:MM, v:DEGREES[:MM[:END]] or point");
}

std::string to_text(const ToolTip& tip) {
    switch (tip.kind) {
    case TipKind::ball:
        return "ball:" + shortest(tip.diameter);
    case TipKind::flat:
        return "flat:" + shortest(tip.diameter);
    case TipKind::v:
        return fmt::format("v:{}:{}", shortest(to_degrees(tip.angle)), shortest(tip.diameter)) +
               end_text(tip);
    case TipKind::point:
        break;
    }
    return "point";
}

} // namespace millwright::plot
