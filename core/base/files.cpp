#include "core/base/files.h"

#include "core/base/error.h"
#include "core/base/internal/write_all.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>
#include <utility>

namespace millwright {

namespace fs = std::filesystem;

namespace {

std::string reason(int error_number) {
    return std::error_code(error_number, std::generic_category()).message();
}

/// A device, a pipe, a socket: nothing that another file could take the place of.
bool is_no_file(const fs::path& file) {
    std::error_code failure;
    const fs::file_status status = fs::status(file, failure);
    return fs::is_other(status);
}

} // namespace

std::string too_large_text(std::size_t most) {
    constexpr std::size_t mebibyte = std::size_t{1} << 20U;
    constexpr std::size_t gibibyte = std::size_t{1} << 30U;
    return "larger than " +
           (most % gibibyte == 0 ? std::to_string(most / gibibyte) + " GiB"
                                 : std::to_string(most / mebibyte) + " MiB") +
           ", the maximum that can be read";
}

std::string read_file(const fs::path& file, std::size_t most) {
    const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0) {
        throw Error("cannot read: " + reason(errno), file);
    }
    const std::unique_ptr<const int, void (*)(const int*)> closing(
        &handle, [](const int* opened) { ::close(*opened); });
    struct stat found {};
    std::string bytes;
    const bool told = ::fstat(handle, &found) == 0 && S_ISREG(found.st_mode);
    if (told && static_cast<std::size_t>(found.st_size) > most) {
        throw Error(too_large_text(most), file);
    }
    if (told) {
        bytes.reserve(static_cast<std::size_t>(found.st_size));
    }
    std::array<char, 65536> buffer{};
    while (true) {
        const ssize_t count = ::read(handle, buffer.data(), buffer.size());
        if (count < 0 && errno == EINTR) {
            continue;
        }
        if (count < 0) {
            throw Error("cannot read: " + reason(errno), file);
        }
        if (count == 0) {
            return bytes;
        }
        if (bytes.size() + static_cast<std::size_t>(count) > most) {
            throw Error(too_large_text(most), file);
        }
        bytes.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

void write_file(const fs::path& file, std::string_view bytes, Privacy privacy) {
    FileWriter writer(file, privacy);
    writer.write(bytes);
    writer.close();
}

FileWriter::FileWriter(const fs::path& file, Privacy privacy) : file_(file) {
    if (!is_no_file(file_)) {
        draft_ = std::make_unique<Draft>(file_, privacy);
        return;
    }
    handle_ = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
    if (handle_ < 0) {
        fail();
    }
}

FileWriter::~FileWriter() {
    if (handle_ >= 0) {
        ::close(handle_);
    }
}

void FileWriter::write(std::string_view bytes) {
    if (draft_) {
        return draft_->write(bytes);
    }
    if (!internal::write_all(handle_, bytes)) {
        fail();
    }
}

void FileWriter::close() {
    if (draft_) {
        draft_->finish();
    } else if (::close(std::exchange(handle_, -1)) != 0) {
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
        throw Error("cannot create the folder: " + why, folder);
    }
}

} // namespace millwright
