// The program of a finishing path for one machine: the tool keeps its axis, links go straight up along it,
// across above the mesh and straight down again. Lengths mm, angles rad, speeds mm/s.
#pragma once

#include "core/base/progress.h"
#include "core/kinematics/machine_model.h"
#include "core/mesh_finish/finishing.h"
#include "core/program/program.h"
#include "core/program/program_settings.h"

#include <string>
#include <vector>

namespace millwright::mesh_finish {

/// `comments` are on its top. Of `settings` the clearances of links do not count: those of the path do.
/// Throws Error for settings out of range, a tool axis that the machine does not reach, an axis outside its
/// limits (with its value and range), or a safe position below the mesh; Cancelled.
[[nodiscard]] program::Program finish_program(const kinematics::MachineModel& machine,
                                              const FinishPath& path,
                                              const program::ProgramSettings& settings,
                                              const std::vector<std::string>& comments,
                                              const Progress& progress);

} // namespace millwright::mesh_finish
