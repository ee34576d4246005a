// A machine of X, Y and Z without limits: of what has no other axes and plans nothing.
#pragma once

#include "core/kinematics/machine_model.h"

#include <utility>

namespace millwright::gcode {

[[nodiscard]] inline kinematics::MachineModel xyz_machine() {
    kinematics::MachineDescription description;
    description.name = "X, Y, Z";
    for (int n = 0; n < 3; ++n) {
        kinematics::MachineAxis axis;
        axis.letter = "XYZ"[n];
        axis.direction = Vec3::Unit(n);
        axis.max_velocity = 1.0; // nothing is planned for it
        axis.max_acceleration = 1.0;
        description.head.push_back(axis);
    }
    return kinematics::MachineModel(std::move(description));
}

} // namespace millwright::gcode
