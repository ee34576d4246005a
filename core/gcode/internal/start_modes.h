// What is in force before the first line of a program, as a controller reports it.
#pragma once

#include "core/gcode/internal/run.h"

#include <string_view>

namespace millwright::gcode::internal {

/// Puts `modes` in force, codes and words with blanks between them, as "G1 G55 G20 G91 M3 F300" (F in mm per
/// minute). Takes motion, plane, unit, distance and feed modes, coordinate system, spindle and feed; leaves
/// out what is of no meaning for a path.
void take_modes(Run& run, std::string_view modes);

} // namespace millwright::gcode::internal
