// The lines of G-code behind the buttons of a machine's panel, for Driver::command(). They hold in every
// dialect that has the codes. Lengths mm, angles rad, speeds mm/s or rad/s.
#pragma once

#include "core/drivers/driver_status.h"
#include "core/program/program.h"

#include <string>

namespace millwright::drivers {

/// M3 or M4 with S. `rpm` >= 0.
[[nodiscard]] std::string start_spindle(double rpm, bool clockwise = true);
[[nodiscard]] std::string stop_spindle();
/// M7 and M8 for what shall be on, after M9.
[[nodiscard]] std::string set_coolant(bool mist, bool flood);

/// "G54" to "G59.3" of 1 to 9: also the line that selects it.
[[nodiscard]] std::string work_system_name(int system);
/// Makes the place where the axis stands `value` in the work system that is in force (G10 L20 P0).
[[nodiscard]] std::string set_work_position(const program::ProgramAxis& axis, double value);

/// G38.2 along one axis by `way`, signed, from where `status` says that the machine stands. G21 G90 G94 are
/// in force afterwards.
[[nodiscard]] std::string probe_line(
    const program::ProgramAxis& axis, int axis_index, double way, double speed, const DriverStatus& status);

} // namespace millwright::drivers
