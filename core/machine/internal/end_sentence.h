// How a job ended, for people.
#pragma once

#include "core/machine/job.h"

#include <string>

namespace millwright::machine::internal {

/// `blocks`: of the job; `elapsed`: s since its start; `line`: where it was as far as is known, 0: not known.
[[nodiscard]] std::string
end_sentence(JobEnd end, const DriverStatus& status, int blocks, double elapsed, int line);

} // namespace millwright::machine::internal
