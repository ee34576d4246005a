// A picture cut into a plate: rows back and forth, as deep as its pixels say. Lengths mm, speeds mm/s; z = 0
// is the top of the plate. Source: KMITL master's thesis 2006, forming software for wood and plastic; what is
// ours: docs/reference/picture.md.
#pragma once

#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/height_field.h"
#include "core/plot/picture/tool_tip.h"

#include <optional>

namespace millwright::plot {

/// Passes that take away what is too much for one, before the last one follows the picture.
struct Roughing {
    double depth_per_pass = 1.0;          ///< > 0
    double allowance = 0.2;               ///< is left for the last pass, >= 0
    std::optional<double> step_over = {}; ///< not given: half of the tool, > 0
};

struct ReliefSettings {
    ToolTip tip = {};
    /// Between rows, > 0. Not given: a pixel, as the thesis.
    std::optional<double> step_over = {};
    /// Moves in a row are joined where the longer one is nowhere deeper, and nowhere so much higher, >= 0. At
    /// 0 equal depths (and equal slopes) still are.
    double merge_tolerance = 0.0;
    bool merge = true; ///< false: a point for each pixel, as the thesis
    std::optional<Roughing> roughing = {};
    double cutting = 10.0;    ///< > 0
    double plunging = 2.0;    ///< > 0
    double safe_height = 5.0; ///< > 0
};

/// From the top left pixel on, every other row backwards, never off the plate between rows: the tool goes up
/// where a pixel between them stands higher. The tip leaves every pixel of the field standing, on each
/// straight move, to 1e-6 mm. Ends at the safe height. Throws Error naming a setting that is out of its
/// range, or for a path of more than 100 million points. Throws Cancelled through `progress`.
[[nodiscard]] CutPath
relief(const HeightField& field, const ReliefSettings& settings, const Progress& progress = Progress());

/// The way around a picture of this size that cuts it out of its plate with a tool of this diameter: a closed
/// stroke, half a pixel and `margin` off its outermost pixels' middles.
[[nodiscard]] Stroke frame(const HeightField& field, double tool_diameter, double margin);

} // namespace millwright::plot
