// Where a program's zero lies on the machine, for who has no controller that keeps it.
#pragma once

#include "core/gcode/reader/settings.h"
#include "core/geometry/vectors.h"

namespace millwright::gcode {

/// Every work system (G54 to G59.3) begins there, mm in machine coordinates, until the program changes it.
void put_origin(ReaderSettings& settings, const Vec3& origin);

} // namespace millwright::gcode
