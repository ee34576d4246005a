#include "core/project/internal/file_lock.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace millwright::project {

std::unique_ptr<FileLock> FileLock::taken(const std::filesystem::path& file) {
    constexpr mode_t owner_only = 0600;
    const int handle = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, owner_only);
    if (handle < 0) {
        throw Error("cannot lock: " + std::error_code(errno, std::generic_category()).message(), file);
    }
    std::unique_ptr<FileLock> lock(new FileLock(handle));
    if (::flock(handle, LOCK_EX | LOCK_NB) == 0) {
        return lock;
    }
    if (errno != EWOULDBLOCK) {
        throw Error("cannot lock: " + std::error_code(errno, std::generic_category()).message(), file);
    }
    return nullptr;
}

FileLock::~FileLock() {
    ::close(handle_);
}

} // namespace millwright::project
