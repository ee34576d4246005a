// Arcs and splines as chords, in the frame of the program.
#pragma once

#include "core/gcode/canon.h"

#include <functional>

namespace millwright::gcode {

using ChordSink = std::function<void(const AxisValues& end)>;

/// Of an arc that begins at `start`, in its unit; the larger one where start and end have not the same.
[[nodiscard]] double arc_radius(const AxisValues& start, const Move& arc);

/// The ends of the chords of an arc that begins at `start`, each nowhere farther than `tolerance` from it (in
/// the unit of the arc) and at most 45 degrees long; the last is exactly the target. The other axes go
/// linearly with the angle; so does the radius where start and end have not the same.
void arc_chords(const AxisValues& start, const Move& arc, double tolerance, const ChordSink& sink);

/// The same by the rule of the KMITL thesis of 2006 on forming software: n = ceil(phi R / length) equal parts
/// of the angle phi (rad), R at the start (eqs 2.1 and 2.2).
void arc_chords_of_length(const AxisValues& start, const Move& arc, double length, const ChordSink& sink);

/// How many chords they make of it, or would: no arc may have more than most_chords.
[[nodiscard]] double chord_count(const AxisValues& start, const Move& arc, double tolerance);
[[nodiscard]] double chord_count_of_length(const AxisValues& start, const Move& arc, double length);
inline constexpr double most_chords = 1e7;

/// The same of a spline, whose first control point is `start`. Halved until the chords are near enough.
void curve_chords(const AxisValues& start, const Curve& curve, double tolerance, const ChordSink& sink);

} // namespace millwright::gcode
