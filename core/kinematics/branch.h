// Choosing among the branches of the inverse kinematics.
#pragma once

#include "core/kinematics/machine_model.h"

#include <span>

namespace millwright::kinematics {

/// Sum of the rotary axes' travel from `a` to `b`, rad.
[[nodiscard]] double
rotary_travel(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b);

/// The branch with the least rotary travel from `previous`; the first of equals. Throws Defect if there is
/// none.
[[nodiscard]] const AxisPositions& nearest_branch(const MachineModel& machine,
                                                  std::span<const AxisPositions> branches,
                                                  const AxisPositions& previous);

} // namespace millwright::kinematics
