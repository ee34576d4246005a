#include "core/jobs/internal/file_lock.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace millwright::jobs::internal {

FileLock::FileLock(const std::filesystem::path& file) {
    std::filesystem::path lock = file;
    lock += ".lock";
    handle_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (handle_ < 0) {
        throw Error("cannot be locked: " + std::error_code(errno, std::generic_category()).message(), lock);
    }
    if (::flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(handle_);
        throw Error(
            "is in use by another instance of Millwright", file, "wait until it has finished, or close it");
    }
}

FileLock::~FileLock() {
    ::close(handle_);
}

} // namespace millwright::jobs::internal
