// Machine files: JSON, described field by field in docs/reference/machine-file.md. Lengths mm, angles deg,
// rates per second (mm/s, deg/s).
#pragma once

#include "core/kinematics/machine_model.h"

#include <filesystem>

namespace millwright::kinematics {

/// Throws Error with file, line and field for anything wrong in it.
[[nodiscard]] MachineModel read_machine(const std::filesystem::path& file);

} // namespace millwright::kinematics
