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
};

struct Chart {
    std::string title;
    std::string x_label;
    std::string y_label;
    std::string y_unit;
    bool y_is_log = false;
    std::vector<ChartLine> lines;
};

/// The charts one below the other. Throws Error where nothing can be drawn.
[[nodiscard]] render::Picture
chart_picture(const std::vector<Chart>& charts, const render::PixelSize& size, render::Theme theme);

} // namespace millwright::viewport
