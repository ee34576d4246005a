// How an HPGL file is to be taken: the length of its unit, how its lines end, how strictly it is read.
#pragma once

#include "core/geometry/vectors.h"

#include <cstdint>
#include <optional>

namespace millwright::hpgl {

/// Length of a plotter unit on each axis, mm.
struct PlotterUnit {
    double x = 0.025;
    double y = 0.025;

    friend bool operator==(const PlotterUnit&, const PlotterUnit&) = default;
};

/// 40 units a millimetre, HP's nominal unit and the one that the hatch lines printed in the KMITL thesis of
/// 2006 (forming software for wood and plastic) agree with.
inline constexpr PlotterUnit nominal_unit{0.025, 0.025};
/// About 40.2 units a millimetre: the unit that explains the errors of up to 0.01 mm that the KMITL thesis on
/// the HPGL decoder of an XYZ table reports for its 1899 sizes.
inline constexpr PlotterUnit table_unit{0.02488, 0.02488};

/// What the end of a line means inside the numbers of a command.
enum class LineEnds {
    automatic, ///< one of the others, as the file shows; where it does not show, reading ends with an Error
    join,      ///< nothing: lines are wrapped in the middle of numbers
    separate   ///< a separator, like a blank
};

enum class Strictness {
    tolerant, ///< what is wrong is left out and reported
    strict    ///< the first thing that is wrong ends the reading
};

/// What becomes of filled polygons, rectangles and wedges.
enum class FillMode {
    hatched, ///< lines as the fill type says; solid ones a pen width apart
    outline, ///< their edges
    none
};

struct HpglSettings {
    PlotterUnit unit;
    LineEnds line_ends = LineEnds::automatic;
    Strictness strictness = Strictness::tolerant;
    FillMode fill = FillMode::hatched;
    bool dashes = true; ///< line types are drawn as dashes; else as solid lines
    /// Scaling points P1 and P2 while the file says nothing: the span of HP's desk plotters on an A4 sheet,
    /// with its corner at the origin. Plotter units.
    Vec2 p1 = Vec2(0.0, 0.0);
    Vec2 p2 = Vec2(10000.0, 7200.0);
    /// Arcs are drawn with chords as the file asks for, and with more where they would leave the arc by more
    /// than this; mm. Not given: as the file asks for.
    std::optional<double> arc_tolerance;
    /// Of the origin on each axis, mm: where PA, PR, PU or PD leads farther two numbers have become one.
    double farthest = 20'000.0;
    int highest_pen = 255;
    std::int64_t most_points = 20'000'000; ///< of all strokes; reading ends with an Error beyond
    int most_diagnostics = 100;            ///< kept; the others are counted

    friend bool operator==(const HpglSettings&, const HpglSettings&) = default;
};

} // namespace millwright::hpgl
