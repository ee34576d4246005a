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

mode_t mode_for(const fs::path& target) {
    struct stat old {};
    if (::stat(target.c_str(), &old) == 0) {
        return old.st_mode & 0777U;
    }
    constexpr mode_t everyone_reads = 0644;
    return everyone_reads;
}

/// A device, a pipe, a socket: nothing that another file could take the place of.
bool is_no_file(const fs::path& file) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    return fs::is_other(status);
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
    FileWriter writer(file);
    writer.write(bytes);
    writer.close();
}

FileWriter::FileWriter(fs::path file) : file_(std::move(file)) {
    std::error_code failure;
    if (is_no_file(file_)) {
        handle_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
        if (handle_ < 0) {
            fail();
        }
        return;
    }
    if (fs::is_symlink(file_, failure)) {
        file_ = fs::weakly_canonical(file_);
    }
    if (fs::is_directory(file_, failure)) {
        throw Error("cannot write: " + reason(EISDIR), file_);
    }
    draft_ = file_.string() + ".XXXXXX";
    handle_ = ::mkstemp(draft_.data());
    if (handle_ < 0) {
        fail();
    }
}

FileWriter::~FileWriter() {
    if (handle_ >= 0) {
        ::close(handle_);
        if (!writes_through()) {
            ::unlink(draft_.c_str());
        }
    }
}

void FileWriter::write(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(handle_, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written < 0) {
            fail();
        }
        bytes.remove_prefix(static_cast<std::size_t>(written));
    }
}

void FileWriter::finish_draft() {
    if (::fchmod(handle_, mode_for(file_)) != 0 || ::fsync(handle_) != 0 ||
        ::rename(draft_.c_str(), file_.c_str()) != 0) {
        fail();
    }
}

void FileWriter::close() {
    if (!writes_through()) {
        finish_draft();
    }
    if (::close(std::exchange(handle_, -1)) != 0) {
        fail();
    }
}

void FileWriter::fail() const {
    throw Error("cannot write: " + reason(errno), file_);
}

void make_folder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    std::error_code unknown; // as of a name too long, or below what may not be entered
    if (!fs::is_directory(folder, unknown)) {
        const std::string why = failure ? failure.message() : reason(ENOTDIR);
        throw Error("cannot make the folder: " + why, folder);
    }
}

} // namespace millwright
