// Machine files: JSON, described field by field in docs/reference/machine-file.md. Lengths mm, angles deg,
// rates per second (mm/s, deg/s).
#pragma once

#include "core/kinematics/machine_model.h"

#include <filesystem>

namespace millwright::kinematics {

// The greatest numbers that files of machines and arms may hold: what is beyond them is a slip of the pen.

inline constexpr double farthest_mm = 1e5;
inline constexpr double most_degrees = 36000.0;

/// Throws Error with file, line and field for anything wrong in it.
[[nodiscard]] MachineModel read_machine(const std::filesystem::path& file);

} // namespace millwright::kinematics
