// Cutter radius compensation, G40 to G42.1: the programmed contour is offset by the tool's radius to its left
// or right. Convex corners get an arc about the corner, concave ones the intersection of the two offset
// paths; so each move waits for the next one. The geometry is that of LinuxCNC: a move of no length in the
// plane does not count, and where the tool does not fit the line is refused.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

void start_compensation(Run& run, const Block& block, int code); ///< G41, G41.1, G42, G42.1
void stop_compensation(Run& run);                                ///< G40

/// A straight move to the programmed `end`, while compensation is on and its radius is not zero.
void compensate_straight(Run& run, MoveKind kind, const AxisValues& end);

/// An arc as programmed: its start is the programmed position, or the tool's for the first move.
void compensate_arc(Run& run, const Move& arc, int column);

} // namespace millwright::gcode::internal
