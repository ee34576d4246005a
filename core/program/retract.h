// Where the tool is out of everything's way.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program_settings.h"

namespace millwright::program {

/// The linear axis that pulls the tool off the part and the sense in which it does.
struct RetractAxis {
    int axis = 0;
    double sense = 1.0; ///< +1: growing positions pull off
};

/// The linear axis most nearly along the tool's axis, with the rotary axes at their physical zero.
[[nodiscard]] RetractAxis retract_axis(const kinematics::MachineModel& machine);

/// The position of the retract axis where everything else may move: as set, else its travel limit. Throws
/// Error if it is not set and there is no limit.
[[nodiscard]] double safe_position(const kinematics::MachineModel& machine, const ProgramSettings& settings);

/// `positions` with the retract axis at its safe position.
[[nodiscard]] kinematics::AxisPositions retracted(const kinematics::MachineModel& machine,
                                                  kinematics::AxisPositions positions,
                                                  const ProgramSettings& settings);

} // namespace millwright::program
