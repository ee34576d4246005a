// What lies beyond the travel of an axis, for people.
#pragma once

#include "core/kinematics/machine_model.h"

#include <string>

namespace millwright::kinematics {

/// A sentence with position and limits in mm or degrees; empty if `position` (mm or rad) is within them.
[[nodiscard]] std::string beyond_travel(const MachineAxis& axis, double position);

} // namespace millwright::kinematics
