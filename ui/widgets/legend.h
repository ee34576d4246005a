// What the colours of a picture mean: a bar of the colour map with ticks and units.
#pragma once

#include "ui/widgets/ui.h"

#include <functional>
#include <optional>
#include <string_view>

namespace millwright::widgets {

/// From 0 (low end) to 1 (high end).
using ColourMap = std::function<Colour(double)>;

struct LegendView {
    std::string_view title = {};
    std::string_view unit = {}; ///< empty for a number without one
    double low = 0.0;
    double high = 1.0;
    ColourMap map = {};
    std::optional<Colour> over = {};    ///< shown above the bar: the one colour of everything over `high`
    std::optional<double> largest = {}; ///< above `high` the bar ends in an arrow, with words
    std::string_view tip = {};
    bool lying = false; ///< the bar runs from left to right, beside the title; one line is high enough
};

/// Draws a legend into `place` of the current pane, over what is there; true when it was clicked.
bool legend(Ui& ui, std::string_view id, const Rect& place, const LegendView& view);

} // namespace millwright::widgets
