// V-carving: a V-bit along the medial axis of closed outlines, at each place so deep that its cone touches
// the outline on both sides, and up to the surface in their corners. Lengths mm, speeds mm/s; z = 0 is the
// top of the work. Formulas and limits: docs/reference/carving.md.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot_strokes/strokes.h"

#include <optional>
#include <vector>

namespace millwright::plot {

struct CarvingSettings {
    ToolTip tip = {TipKind::v, 6.0, 1.0471976};
    /// No deeper than this, > 0; not given: as deep as the bit is wide enough for.
    std::optional<double> largest_depth = {};
    /// Deeper cuts are made in equal passes no deeper than this, > 0; not given: one pass.
    std::optional<double> depth_per_pass = {};
    /// Where outlines are wider than the bit reaches the floor is cleared by it; else it is left, but for one
    /// pass along its edge.
    bool clear_floor = true;
    /// Between the passes that clear it, > 0; not given: so that ridges are a tenth of its depth.
    std::optional<double> step_over = {};
    double tolerance = 0.01;  ///< of place and depth, > 0
    double close_gaps = 0.05; ///< ends of outlines so near are joined, > 0
    double cutting = 10.0;    ///< > 0; slower where the bit would go down faster than it plunges
    double plunging = 2.0;    ///< > 0
    double safe_height = 5.0; ///< > 0

    friend bool operator==(const CarvingSettings&, const CarvingSettings&) = default;
};

/// How near chords have to keep to curves that are carved within `tolerance`, mm: the corners between them
/// are pruned then, and are no branches that the bit would go up.
[[nodiscard]] constexpr double carving_chords(double tolerance) {
    return 0.1 * tolerance;
}

struct CarvingFigures {
    int parts = 0;     ///< of the carved area, each carved as a whole
    double area = 0.0; ///< inside the outlines, square mm
    double deepest = 0.0;
    double floor_area = 0.0;  ///< where outlines are wider than the bit reaches, square mm
    double floor_left = 0.0;  ///< of it, not cleared, square mm
    double ridge = 0.0;       ///< height of what stands between passes on the floor, at the most
    double narrow_area = 0.0; ///< too narrow for the flat end of the bit, square mm
    double deviation = 0.0;   ///< by which the bit cuts beyond an outline, at the most
};

struct Carving : CarvingFigures {
    CutPath path;
    std::vector<Diagnostic> notices; ///< on the outlines, and on what is left
};

/// Carves what the closed strokes surround, by the even-odd rule, whatever their pens: nearest part next, in
/// each nearest cut next. Begins and ends at the safe height. Throws Error for a setting out of its range, a
/// tool that is no V, where nothing is closed or nothing can be carved, and as medial_axis(); Cancelled.
[[nodiscard]] Carving
v_carving(const Strokes& drawn, const CarvingSettings& settings, const Progress& progress = Progress());

} // namespace millwright::plot
