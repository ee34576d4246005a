// Arm files: docs/reference/arm.md.
#pragma once

#include "core/arm/arm_actuators.h"
#include "core/arm/arm_bodies.h"
#include "core/arm/arm_model.h"

#include <filesystem>
#include <optional>

namespace millwright::arm {

struct ArmFile {
    ArmModel arm;
    std::optional<ArmActuators> actuators; ///< where the file describes its drives
    std::optional<ArmBodies> bodies;       ///< where it names them; not yet read
};

/// Throws Error with the place of what is wrong.
[[nodiscard]] ArmFile read_arm(const std::filesystem::path& file);

} // namespace millwright::arm
