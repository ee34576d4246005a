// Going once around the box of what a program cuts, above it and with the spindle off: to see, before the
// job, whether the part lies there and no clamp is in the way.
#pragma once

#include "core/jobs/job.h"
#include "core/jobs/program_check.h"

namespace millwright::jobs {

/// A job of a text: up to the highest Z that the program reaches, if the machine is lower, then along the
/// four sides of its cuts in X and Y, 1000 mm/min, in machine coordinates. `program_check` is that of `job`,
/// from where the machine stands. Throws Error if the program cuts nothing in X and Y.
[[nodiscard]] Job box_trace_job(const Job& job, const ProgramCheck& program_check);

} // namespace millwright::jobs
