// Where canonical positions are on the machine: unit, offsets and rotation, as LinuxCNC's canonical layer
// applies them (Proctor et al., NISTIR 6556; LinuxCNC, emccanon): (position + G92) turned about Z, + G5x +
// tool.
#pragma once

#include "core/gcode/canon.h"

#include <functional>

namespace millwright::gcode {

/// Machine positions in mm and degrees.
class CanonFrame {
public:
    /// Takes in a command that changes the frame; others leave it as it is. Offsets are in the unit that is
    /// in force.
    void command(const Command& command);

    [[nodiscard]] double unit() const { return unit_; } ///< mm
    [[nodiscard]] AxisValues to_machine(const AxisValues& position) const;
    [[nodiscard]] AxisValues from_machine(const AxisValues& position) const;

private:
    [[nodiscard]] static AxisValues turned(AxisValues values, double angle);

    double unit_ = 1.0;
    double rotation_ = 0.0;       ///< rad
    AxisValues g5x_, g92_, tool_; ///< mm and degrees
};

// Arcs and splines as chords, in the frame of the program.

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
