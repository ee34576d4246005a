// The rest of a program whose motion is planned here, from a line of its listing on, behind an approach.
#pragma once

#include "core/jobs/run_from_line.h"

namespace millwright::jobs::internal {

/// As job_from_line(), for a job with a program.
[[nodiscard]] Job program_from_line(const Job& job, int line, const RunFromSettings& settings);

} // namespace millwright::jobs::internal
