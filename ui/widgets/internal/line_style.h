// What tells curves apart: their colour, then dashes, and a sign at each value.
#pragma once

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/plot.h"

#include <span>
#include <vector>

namespace millwright::widgets {

/// The series with the colour that each is drawn in. Where there are more than the palette has, the next ones
/// are dashed, and then dotted.
[[nodiscard]] std::vector<Series> with_looks(const Palette& colours, std::span<const Series> series);

/// `dash`: px. Dashes go on round corners.
void draw_stroke(const std::vector<ImVec2>& run, Stroke stroke, Colour colour, float thickness, float dash);
/// About `at`, `size` px from there.
void draw_marker(Marker marker, ImVec2 at, Colour colour, float size);

} // namespace millwright::widgets
