#include "core/base/files.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

namespace millwright {

namespace fs = std::filesystem;

namespace {

std::string reason(int error_number) {
    return std::error_code(error_number, std::generic_category()).message();
}

/// A file being written: closed and removed again unless kept.
class Draft {
public:
    explicit Draft(const fs::path& target) : name_(target.string() + ".XXXXXX") {
        handle_ = ::mkstemp(name_.data());
        if (handle_ < 0) {
            throw Error("cannot write: " + reason(errno), target);
        }
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    ~Draft() {
        if (handle_ >= 0) {
            ::close(handle_);
            ::unlink(name_.c_str());
        }
    }

    void write(std::string_view bytes, const fs::path& target) const {
        while (!bytes.empty()) {
            const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) {
                continue;
            }
            if (written < 0) {
                throw Error("cannot write: " + reason(errno), target);
            }
            bytes.remove_prefix(static_cast<std::size_t>(written));
        }
    }

    void rename_to(const fs::path& target, mode_t mode) {
        if (::fchmod(handle_, mode) != 0 || ::fsync(handle_) != 0 ||
            ::rename(name_.c_str(), target.c_str()) != 0) {
            throw Error("cannot write: " + reason(errno), target);
        }
        ::close(handle_);
        handle_ = -1;
    }

private:
    std::string name_;
    int handle_ = -1;
};

mode_t mode_for(const fs::path& target) {
    struct stat old {};
    if (::stat(target.c_str(), &old) == 0) {
        return old.st_mode & 0777U;
    }
    constexpr mode_t everyone_reads = 0644;
    return everyone_reads;
}

} // namespace

std::string read_file(const fs::path& file) {
    std::error_code failure;
    if (fs::is_directory(file, failure)) {
        throw Error("cannot read: " + reason(EISDIR), file);
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        throw Error("cannot read: " + reason(errno), file);
    }
    std::ostringstream bytes;
    if (in.peek() != std::ifstream::traits_type::eof() && !(bytes << in.rdbuf())) {
        throw Error("cannot read: " + reason(EIO), file);
    }
    return std::move(bytes).str();
}

void write_file(const fs::path& file, std::string_view bytes) {
    std::error_code failure;
    const fs::path target = fs::is_symlink(file, failure) ? fs::weakly_canonical(file) : file;
    if (fs::is_directory(target, failure)) {
        throw Error("cannot write: " + reason(EISDIR), file);
    }
    Draft draft(target);
    draft.write(bytes, target);
    draft.rename_to(target, mode_for(target));
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (!fs::is_directory(folder)) {
        const std::string why = failure ? failure.message() : reason(ENOTDIR);
        throw Error("cannot make the folder: " + why, folder);
    }
}

} // namespace millwright
