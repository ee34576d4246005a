// The constants of the thesis's rotary-tilt machine in a machine file: read from its axes, and put there.
// Source: Parasilmongkol 1997, ch. 3 and the dialog Tool Set (a, b, c, e, OF, AB, B4).
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/kinematics/rotary_tilt.h"

#include <optional>

namespace millwright::kinematics {

/// The constants of `machine`; nothing where it is built otherwise. A machine has only the difference
/// B4 - OF, the height of the tool tip over the tilt axis: OF is its `tip_to_base` (0 without one) for the
/// machine file's own tool, and as much more as the tool in the spindle is longer.
[[nodiscard]] std::optional<RotaryTilt> rotary_tilt_of(const MachineModel& machine);

/// `machine` with these constants and this place of the part; its bodies stay where its file has them. Throws
/// Error where rotary_tilt_of() knows none.
[[nodiscard]] MachineModel with_rotary_tilt(const MachineModel& machine, const RotaryTilt& constants);

} // namespace millwright::kinematics
