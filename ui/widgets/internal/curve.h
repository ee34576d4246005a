// Curves of any number of points: what falls on one column of pixels is drawn once, from its least to its
// greatest value, so that no peak is lost.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <span>
#include <vector>

namespace millwright::widgets {

/// From values to pixels. Values that are not finite have no place.
struct Mapping {
    Rect box;
    double x_low = 0.0;
    double x_high = 1.0;
    double y_low = 0.0;
    double y_high = 1.0;
    bool y_is_log = false;

    [[nodiscard]] bool has_place(double x, double y) const;
    [[nodiscard]] float pixel_x(double x) const;
    [[nodiscard]] float pixel_y(double y) const;
    [[nodiscard]] double value_x(float pixel) const;
};

/// Runs of points between values without a place; x ascending. At most four points a column of pixels.
[[nodiscard]] std::vector<std::vector<ImVec2>>
runs(const Mapping& mapping, std::span<const double> x, std::span<const double> y);

void draw_run(const std::vector<ImVec2>& run, Colour colour, float thickness);
/// The area between the run and `bottom`.
void fill_below(const std::vector<ImVec2>& run, float bottom, Colour colour);

} // namespace millwright::widgets
