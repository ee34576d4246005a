// What a person should know of a queued job that did not come to its end, before it is decided what becomes
// of it.
#pragma once

#include "core/jobs/job_queue.h"

#include <filesystem>
#include <string>

namespace millwright::app {

/// What the queue says; with its log in `folder`, if there is one, also what that reports but is not in the
/// queue if this program was killed: what was executed, and where the job can go on.
[[nodiscard]] std::string queued_job_status(const jobs::QueuedJob& job, const std::filesystem::path& folder);

} // namespace millwright::app
