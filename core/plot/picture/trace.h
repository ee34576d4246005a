// Tracing: the outlines of what is dark in a picture, as Bezier curves. By potrace's library (Peter Selinger,
// "Potrace: a polygon-based tracing algorithm", 2003). Lengths in pixels unless named otherwise.
#pragma once

#include "core/plot/picture/picture.h"
#include "core/plot_strokes/strokes.h"

#include <string>
#include <vector>

namespace millwright::plot {

/// Which way an outline turns where two dark pixels touch at a corner only.
enum class TurnPolicy {
    connect_black,
    connect_white,
    left,
    right,
    minority, ///< connects what there is less of nearby
    majority
};

struct TraceSettings {
    double threshold = 0.5; ///< what is not brighter is dark, 0 to 1
    int speckle = 2;        ///< outlines around so few pixels are left out, >= 0
    double corner = 1.0;    ///< 0: all corners stay; 1.3334: none does
    double tolerance = 0.2; ///< by which curves that are joined may change, pixels; 0: none are joined
    TurnPolicy turns = TurnPolicy::minority;

    friend bool operator==(const TraceSettings&, const TraceSettings&) = default;
};

/// A Bezier curve of degree 3 from the end of the one before it; a straight line has its control points on
/// its ends.
struct TracedCurve {
    Vec2 first = Vec2::Zero();
    Vec2 second = Vec2::Zero();
    Vec2 end = Vec2::Zero();
    bool straight = false;
};

/// A closed outline; x to the right, y up, from the picture's lower left corner.
struct TracedPath {
    Vec2 start = Vec2::Zero(); ///< and the end of the last curve
    bool hole = false;
    std::vector<TracedCurve> curves;
};

/// Outlines in the order in which potrace finds them: each before its holes. Throws Error naming a setting
/// that is out of its range.
[[nodiscard]] std::vector<TracedPath> trace(const Picture& picture, const TraceSettings& settings = {});

/// The outlines as closed strokes in mm, chords within `tolerance` mm of their curves; pixels are `pitch` mm
/// wide. Throws Error unless both are above 0 and finite.
[[nodiscard]] Strokes
strokes_of(const std::vector<TracedPath>& paths, double pitch, double tolerance, int pen = 1);

/// An SVG of the picture's size in mm: one black path, filled by the even-odd rule.
[[nodiscard]] std::string
svg_text(const std::vector<TracedPath>& paths, const Picture& picture, double pitch);

} // namespace millwright::plot
