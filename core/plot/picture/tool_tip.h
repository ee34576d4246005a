// The shape of a cutter's tip, around an upright axis. Lengths mm, angles rad.
#pragma once

#include <string>
#include <string_view>

namespace millwright::plot {

enum class TipKind {
    point, ///< infinitely thin: touches right below itself only
    ball,  ///< half a sphere
    flat,  ///< an end mill
    v      ///< a cone; its end is a point, flat or round
};

struct ToolTip {
    TipKind kind = TipKind::ball;
    double diameter = 1.0;    ///< > 0; of a point it does not count
    double angle = 1.0471976; ///< of a V between its sides, above 0 and below pi; 60 degrees
    double end_width = 0.0;   ///< of the flat end of a V, >= 0
    double end_radius = 0.0;  ///< of the round end of a V, or of the rounding around a flat one, >= 0

    friend bool operator==(const ToolTip&, const ToolTip&) = default;
};

/// 0 for a point.
[[nodiscard]] double radius(const ToolTip& tip);

/// How far the tip's surface is above its lowest point, at `distance` from the axis, >= 0; infinite beyond
/// the radius.
[[nodiscard]] double rise(const ToolTip& tip, double distance);

/// Its derivative by the distance, inside of the radius.
[[nodiscard]] double rise_slope(const ToolTip& tip, double distance);

/// Of the mouth of the hole that it makes, so deep below the top, >= 0.
[[nodiscard]] double mouth_radius(const ToolTip& tip, double depth);

/// `point`, `ball:DIAMETER`, `flat:DIAMETER`, `v:DEGREES`, `v:DEGREES:DIAMETER` (6 mm if not given) or
/// `v:DEGREES:DIAMETER:END`, whose end is the width of a flat end or `r` and the radius of a round one.
/// Throws Error quoting what is none of them or out of its range.
[[nodiscard]] ToolTip parse_tool_tip(std::string_view text);

/// As `parse_tool_tip` takes it.
[[nodiscard]] std::string to_text(const ToolTip& tip);

} // namespace millwright::plot
