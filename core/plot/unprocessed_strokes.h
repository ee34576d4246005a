// What a person should know of strokes that were to be compensated or filled.
#pragma once

#include "core/plot/stroke_plan.h"

#include <string>

namespace millwright::plot {

/// One line on those of the drawing that are not closed and stay as they are, and on parts of it that the
/// tool does not fit into; empty: there are none, or nothing was asked for.
[[nodiscard]] std::string
unprocessed_strokes(const Strokes& drawn, const ShapedStrokes& shaped, const StrokePlan& plan);

} // namespace millwright::plot
