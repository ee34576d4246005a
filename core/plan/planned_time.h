// What the machine needs for a path before there is a program of it.
#pragma once

#include "core/base/progress.h"
#include "core/project/project.h"
#include "core/toolpath/sequencing.h"

#include <optional>

namespace millwright::plan {

/// Of a program of this path, by the motion planner, s; nothing where the machine can run none. Throws
/// Cancelled.
[[nodiscard]] std::optional<double> planned_time(const toolpath::Toolpath& path,
                                                 const toolpath::AxisPath& axes,
                                                 const kinematics::MachineModel& machine,
                                                 const project::ProgramInput& input,
                                                 const Progress& progress);

} // namespace millwright::plan
