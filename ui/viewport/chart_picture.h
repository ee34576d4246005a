// Lines over a common x as a picture for a file.
#pragma once

#include "ui/render/picture.h"
#include "ui/render/pixel_size.h"
#include "ui/render/view_colors.h"

#include <string>
#include <vector>

namespace millwright::viewport {

struct ChartLine {
    std::string label;
    std::vector<double> x; ///< ascending
    std::vector<double> y; ///< as many; values that are not finite leave a gap
    bool is_filled = false;
    std::string caption = {}; ///< above its middle
};

struct ChartTick {
    double at = 0.0;
    std::string text;
};

struct Chart {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::string y_unit;
    bool y_is_log = false;
    std::vector<ChartLine> lines;
    std::vector<ChartTick> x_ticks = {}; ///< ascending; empty: round numbers
    bool shows_values = false;           ///< a sign at each: for few values, and y fitted to them
    bool has_key = true;                 ///< the lines' labels
};

/// The charts one below the other. Throws Error where nothing can be drawn.
[[nodiscard]] render::Picture
chart_picture(const std::vector<Chart>& charts, const render::PixelSize& size, render::Theme theme);

} // namespace millwright::viewport
