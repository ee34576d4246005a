// How long a machine takes for the program of a plot: of the text that was written, read and planned as every
// G-code file that is opened, so that window and command line say the same.
#pragma once

#include "core/base/progress.h"
#include "core/kinematics/machine_model.h"
#include "core/posts/release.h"

#include <filesystem>

namespace millwright::plan {

/// By the motion planner, from zero or the nearest limit of each axis, s. A text that is no G-code as
/// LinuxCNC and Grbl read it is planned by the blocks that it says. `file` is named in diagnostics. Throws
/// Error, or Cancelled.
[[nodiscard]] double seconds_of_text(const posts::ReleasedText& released,
                                     const posts::PostFormat& format,
                                     const kinematics::MachineModel& machine,
                                     const std::filesystem::path& file,
                                     const Progress& progress = Progress());

} // namespace millwright::plan
