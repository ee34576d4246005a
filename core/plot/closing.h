// Outlines that are drawn line by line, as those of LINE entities: strokes whose ends touch, put together to
// closed ones. Lengths mm.
#pragma once

#include "core/plot/stroke_plan.h"
#include "core/plot_strokes/strokes.h"

namespace millwright::plot {

/// Open strokes of one pen that go around with nothing else at their ends become one closed stroke, in the
/// place and the direction of the first of them; all others stay as they are. Ends touch where they are no
/// farther apart than `tolerance`.
[[nodiscard]] Strokes rings_joined(const Strokes& strokes, double tolerance = 0.05);

/// What the plan fills, compensates or keeps links in: rings joined where it does any of it, else the strokes
/// as drawn. Throws Error where it compensates and there is nothing closed: what was to be cut outside would
/// come out too small.
[[nodiscard]] Strokes outlines_for(const Strokes& drawn, const StrokePlan& plan);

} // namespace millwright::plot
