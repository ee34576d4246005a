// Strokes as a picture that browsers and drawing programs show. Lengths mm.
#pragma once

#include "core/plot_strokes/strokes.h"

#include <string>

namespace millwright::plot {

/// What an SVG shows of the travel with the pen up.
enum class AirInSvg { shown, left_out };

/// An SVG in mm, a path for each run of one pen in its colour; travel from (0, 0) through the strokes is
/// thin, gray and dashed. Throws Error if there are no strokes.
[[nodiscard]] std::string svg_text(const Strokes& strokes, AirInSvg air);

} // namespace millwright::plot
