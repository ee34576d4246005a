// Curves of any number of points: what falls on one column of pixels is drawn once, from its least to its
// greatest value, so that no peak is lost.
#pragma once

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/plot.h"

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

// What tells curves apart: their colour, then dashes, and a sign at each value.

/// The series with the colour that each is drawn in. Where there are more than the palette has, the next ones
/// are dashed, and then dotted.
[[nodiscard]] std::vector<Series> with_looks(const Palette& colours, std::span<const Series> series);

/// `dash`: px. Dashes go on round corners.
void draw_stroke(const std::vector<ImVec2>& run, Stroke stroke, Colour colour, float thickness, float dash);
/// About `at`, `size` px from there.
void draw_marker(Marker marker, ImVec2 at, Colour colour, float size);

} // namespace millwright::widgets
