// What tells curves apart beside their colour, of which there are six: dashes, and a sign at each value.
#pragma once

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/plot.h"

#include <vector>

namespace millwright::widgets {

/// `dash`: px. Dashes go on round corners.
void draw_stroke(const std::vector<ImVec2>& run, Stroke stroke, Colour colour, float thickness, float dash);
/// About `at`, `size` px from there.
void draw_marker(Marker marker, ImVec2 at, Colour colour, float size);

} // namespace millwright::widgets
