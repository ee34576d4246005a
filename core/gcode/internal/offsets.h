// Coordinate systems, offsets and units: everything that changes what a coordinate means.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

/// Turns X and Y about the origin by `degrees`, counter-clockwise.
[[nodiscard]] AxisValues rotated(AxisValues values, double degrees);

/// Where the point `machine` (machine coordinates, program unit) is in the active coordinate system, for G53,
/// G28 and G30. As in LinuxCNC, the tool offset along A, B and C is not taken off.
[[nodiscard]] AxisValues relative_to_system(const AxisValues& machine, const ModalState& state);

void send_system(Run& run);   ///< the offset in force, and of which axes it is known
void send_rotation(Run& run); ///< of that system, and whether it is known
void send_g92(Run& run);

void set_units(Run& run, int code);                            ///< G20, G21
void select_coordinate_system(Run& run, int code);             ///< G54 to G59.3
void set_tool_length(Run& run, const Block& block, int code);  ///< G43, G43.1, G43.2, G49
void set_axis_offsets(Run& run, const Block& block, int code); ///< G52, G92 to G92.3
void set_coordinate_data(Run& run, const Block& block);        ///< G10
void go_to_reference(Run& run, const Block& block, int code);  ///< G28, G30
void set_reference(Run& run, int code);                        ///< G28.1, G30.1
/// M2 and M30 go back to G54.
void reset_coordinate_system(Run& run);

} // namespace millwright::gcode::internal
