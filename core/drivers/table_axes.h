// The axes of a table that is sent points.
#pragma once

#include "core/kinematics/machine_model.h"

#include <array>
#include <cstddef>

namespace millwright::drivers {

/// Where X, Y and Z are among the machine's axes. Throws Error if one is missing.
[[nodiscard]] std::array<std::size_t, 3> table_axes(const kinematics::MachineModel& model);

} // namespace millwright::drivers
