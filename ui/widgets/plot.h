// Lines over a common x: errors along the path, the norm over the iterations, feed over time.
#pragma once

#include "ui/widgets/ui.h"

#include <optional>
#include <span>
#include <string_view>

namespace millwright::widgets {

enum class Stroke { solid, dashed, dotted };
enum class Marker { none, disc, ring, square, triangle, cross };

struct Series {
    std::string_view label;
    std::span<const double> x; ///< ascending
    std::span<const double> y; ///< as many; values that are not finite leave a gap
    Colour colour =
        0; ///< 0: the next of the palette's series; where these are used up the stroke changes, too
    bool is_filled = false;
    Stroke stroke = Stroke::solid;
    Marker marker = Marker::none;  ///< at each value
    std::string_view caption = {}; ///< above the middle of the curve
};

struct AxisTick {
    double at = 0.0;
    std::string_view text;
};

struct PlotView {
    std::string_view x_label = {};
    std::string_view x_unit = {};
    std::string_view y_label = {};
    std::string_view y_unit = {};
    std::span<const Series> series = {};
    std::optional<double> cursor_x = {};    ///< where the machine stands: an upright line
    std::optional<double> limit_y = {};     ///< a dashed line, such as the tolerance
    bool y_is_log = false;                  ///< zeros are marked below the curves, what is less leaves a gap
    bool y_from_zero = true;                ///< else from the least value
    bool y_is_fitted = false;               ///< a logarithmic y ends at the values, else at powers of ten
    std::span<const AxisTick> x_ticks = {}; ///< ascending; empty: round numbers
    bool has_key = true;                    ///< the series' labels above the plot
    float height = 0.0F;                    ///< 0: all that is left, at least 80 px at scale 1
    std::string_view when_empty = "No data to plot yet.";
};

/// The x that was just clicked, inside the range of x. The mouse over it reads out the values nearest in x.
std::optional<double> line_plot(Ui& ui, std::string_view id, const PlotView& view);

} // namespace millwright::widgets
