// The program of a plan: G-code, motion and time of the path that it follows.
#pragma once

#include "core/base/progress.h"
#include "core/plan/evaluation.h"
#include "core/program/post.h"
#include "core/project/project.h"

#include <optional>

namespace millwright::plan {

struct Plan; // plan.h

[[nodiscard]] program::ProgramSettings program_settings(const project::ProgramInput& input);

/// Program, listing, trajectory and time of the path that the program follows, into `plan`. Throws Error or
/// Cancelled, then `plan` is as it was.
void add_program(Plan& plan, const project::Project& project, const Progress& progress);

/// What a program of `evaluation` would take on `machine`, s; nothing where it can run none. Throws
/// Cancelled.
[[nodiscard]] std::optional<double> estimated_time(const Evaluation& evaluation,
                                                   const kinematics::MachineModel& machine,
                                                   const project::ProgramInput& input,
                                                   const Progress& progress);

/// Plan::unsequenced, where the project asks for another sequence than the nearest angles. Throws Error or
/// Cancelled.
void add_unsequenced(Plan& plan, const project::Project& project, const Progress& progress);

} // namespace millwright::plan
