// Strokes as a picture that browsers and drawing programs show. Lengths mm.
#pragma once

#include "core/plot_strokes/strokes.h"

#include <string>

namespace millwright::plot {

// The groups of colours of the KMITL master's thesis of 2006 (forming software for wood and plastic): red
// (and white), yellow, green, cyan, blue, magenta.

inline constexpr int pen_groups = 6;

/// 0 to 5: pen 1 is red; beyond the sixth they begin anew, below the first backwards.
[[nodiscard]] constexpr int pen_group(int pen) {
    return (pen % pen_groups - 1 + pen_groups) % pen_groups;
}

/// What an SVG shows of the travel with the pen up.
enum class AirInSvg { shown, left_out };

/// An SVG in mm, a path for each run of one pen in its colour; travel from (0, 0) through the strokes is
/// thin, gray and dashed. Throws Error if there are no strokes.
[[nodiscard]] std::string svg_text(const Strokes& strokes, AirInSvg air);

} // namespace millwright::plot
