// Arm files: docs/reference/arm.md.
#pragma once

#include "core/kinematics/arm_actuators.h"
#include "core/kinematics/arm_bodies.h"
#include "core/kinematics/arm_model.h"

#include <filesystem>
#include <optional>

namespace millwright::kinematics {

struct ArmFile {
    ArmModel arm;
    std::optional<ArmActuators> actuators; ///< where the file describes its drives
    std::optional<ArmBodies> bodies;       ///< where it names them; not yet read
};

/// Throws Error with the place of what is wrong.
[[nodiscard]] ArmFile read_arm(const std::filesystem::path& file);

} // namespace millwright::kinematics
