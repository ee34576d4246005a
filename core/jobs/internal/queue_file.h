// The jobs of a queue as a file. Format: docs/reference/job-log.md.
#pragma once

#include "core/jobs/job_queue.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::jobs::internal {

// A file that belongs to one running program at a time.

/// Ends with this program, however it ends. Where a file system knows no locks, there is none.
class FileLock {
public:
    /// Takes `file` with ".lock" added to its name, which stays behind. Throws Error if another program has
    /// it, or with the system's reason.
    explicit FileLock(const std::filesystem::path& file);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock();

private:
    int handle_ = -1;
};

[[nodiscard]] std::string queue_text(const std::vector<QueuedJob>& jobs);

/// Without their programs. Throws Error with file, line and reason for anything wrong.
[[nodiscard]] std::vector<QueuedJob> read_queue(const std::filesystem::path& file);

} // namespace millwright::jobs::internal
