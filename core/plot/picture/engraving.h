// Pictures as dots that are engraved: many of one size, or fewer whose size says how dark it is. Lengths mm,
// speeds mm/s; z = 0 is the top of the work.
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/tool_tip.h"

namespace millwright::plot {

struct DitherSettings {
    double pitch = 0.5; ///< between dots, across and down, > 0
    bool join = false;  ///< neighbours in a row become one stroke
};

/// Dots where it is dark, so many that their number is what the darkness asks for, by error diffusion (Floyd
/// and Steinberg 1976), rows back and forth from the top left; as strokes of one point, or runs. The lower
/// left dot's square has its middle at (pitch / 2, pitch / 2); pixels are `pixel` mm wide and averaged over
/// the square. Throws Error for a pitch or pixel that is not above 0, and for more than 10 million dots'
/// places.
[[nodiscard]] Strokes
dithered(const Picture& picture, double pixel, const DitherSettings& settings, int pen = 1);

struct HalftoneSettings {
    double pitch = 1.0;                         ///< between dots, > 0
    double angle = 0.7853982;                   ///< of their rows to x, rad; 45 degrees
    ToolTip tip = {TipKind::v, 6.0, 1.0471976}; ///< V or ball
    double plunging = 2.0;                      ///< > 0
    double safe_height = 1.0;                   ///< > 0
};

/// Holes on a turned grid, each so deep that its mouth covers as much of its square as is dark there: radius
/// pitch sqrt(darkness / pi), as far as the tip is wide. Begins and ends at the safe height. Throws Error for
/// a setting that is out of its range, for a tip whose holes are all equally wide, and for more than 10
/// million dots.
[[nodiscard]] CutPath halftone(const Picture& picture, double pixel, const HalftoneSettings& settings);

} // namespace millwright::plot
