// A file that one program at a time can lock; the system frees the lock however the program ends.
#pragma once

#include <filesystem>
#include <memory>

namespace millwright::project {

class FileLock {
public:
    /// Null if another holds it. Makes the file where missing; it is never removed, since a lock on a removed
    /// file has no effect. Throws Error if it cannot be opened.
    [[nodiscard]] static std::unique_ptr<FileLock> taken(const std::filesystem::path& file);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    ~FileLock();

private:
    explicit FileLock(int handle) : handle_(handle) {}
    int handle_;
};

} // namespace millwright::project
