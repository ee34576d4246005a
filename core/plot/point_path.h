// The points of a table as what they cut: a path that is drawn, made a program of, and measured. Lengths mm,
// speeds mm/s; z = 0 is the top of the work.
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot_strokes/strokes.h"

#include <vector>

namespace millwright::plot {

struct PointPathSettings {
    double cutting = 10.0; ///< > 0; the points themselves have no speed before their period is known
    double plunging = 2.0; ///< straight down into the work, > 0
    double safe_height = 5.0;
};

/// Points that are not above the top of the work, or not above the lowest one where that is higher, are in
/// the work; between two of them it cuts. Begins and ends at the safe height or higher. Without points it is
/// empty.
[[nodiscard]] CutPath path_of_points(const std::vector<Vec3>& points, const PointPathSettings& settings = {});

/// What is cut, as strokes of pen 1.
[[nodiscard]] Strokes strokes_of_points(const std::vector<Vec3>& points);

} // namespace millwright::plot
