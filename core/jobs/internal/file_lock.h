// A file that belongs to one running program at a time.
#pragma once

#include <filesystem>

namespace millwright::jobs::internal {

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

} // namespace millwright::jobs::internal
