// The jobs of a queue as a file. Format: docs/reference/job-log.md.
#pragma once

#include "core/jobs/job_queue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::jobs::internal {

[[nodiscard]] std::string queue_text(const std::vector<QueuedJob>& jobs);

/// Without their programs. Throws Error with file, line and reason for anything wrong.
[[nodiscard]] std::vector<QueuedJob> read_queue(const std::filesystem::path& file);

} // namespace millwright::jobs::internal
