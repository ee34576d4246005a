// The motions of one block: straight, arcs, splines, probing. Each emits what it makes, moves the state's
// position and remembers the motion mode. All throw Refusal.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

void make_straight(Run& run, const Block& block, int motion);     ///< G0, G1
void make_arc(Run& run, const Block& block, int motion);          ///< G2, G3
void make_spline(Run& run, const Block& block, int motion);       ///< G5, G5.1
void add_nurbs_point(Run& run, const Block& block);               ///< G5.2
void make_nurbs(Run& run, const Block& block);                    ///< G5.3
void make_probe(Run& run, const Block& block, int motion);        ///< G38.2 to G38.5
void make_synchronised(Run& run, const Block& block, int motion); ///< G33, G33.1
void make_threading(Run& run, const Block& block);                ///< G76
void make_cycle(Run& run, Block& block, int motion);              ///< G73, G74, G81 to G89

/// There is no probe here: it is taken for tripped at the target, and the tool for backed off by 0.254 mm
/// (0.01 inch), as rs274 does; #5070 stays 0.
void take_probe_for_tripped(Run& run, const AxisValues& target);

/// A feed move needs a feed. `motion` is for the message.
void expect_feed(const Run& run, const Block& block, int motion);

/// In inverse time mode the feed of a move of `length`, given to the machine.
void set_inverse_time_feed(Run& run, const Block& block, double length);

} // namespace millwright::gcode::internal
