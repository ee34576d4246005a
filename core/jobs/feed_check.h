// Feeds that a machine does not reach.
#pragma once

#include "core/jobs/job.h"

#include <optional>

namespace millwright::jobs {

/// Of a job with a program: the first feed for which an axis would have to be faster than it can, and how
/// many there are. They are executed slower; nothing if there is none.
[[nodiscard]] std::optional<Diagnostic> feeds_not_reached(const Job& job);

} // namespace millwright::jobs
