#include "core/base/file_snapshot.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace millwright {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t step_bytes = std::size_t{1} << 20U;

[[noreturn]] void fail(const char* what, const fs::path& file) {
    throw Error(std::string(what) + ": " + std::strerror(errno), file);
}

class Handle {
public:
    explicit Handle(int number) : number_(number) {}
    Handle(const Handle&) = delete;
    Handle& operator=(const Handle&) = delete;
    ~Handle() {
        if (number_ >= 0) {
            ::close(number_);
        }
    }
    [[nodiscard]] int number() const { return number_; }

private:
    int number_;
};

/// A file without a name, gone with its last user.
int nameless_file(const fs::path& original) {
    std::string name = (fs::temp_directory_path() / "millwright-XXXXXX").string();
    const int made = ::mkstemp(name.data());
    if (made < 0) {
        fail("cannot create a copy in the temporary folder", original);
    }
    ::unlink(name.c_str());
    return made;
}

void write_all(int to, const char* bytes, std::size_t count, const fs::path& original) {
    while (count > 0) {
        const ssize_t written = ::write(to, bytes, count);
        if (written < 0 && errno != EINTR) {
            fail("cannot write the copy in the temporary folder", original);
        }
        const auto done = static_cast<std::size_t>(std::max<ssize_t>(written, 0));
        bytes += done;
        count -= done;
    }
}

std::size_t copy(int from, int to, const fs::path& original, const Progress& progress, std::size_t most) {
    struct stat found {};
    if (::fstat(from, &found) != 0) {
        fail("cannot be read", original);
    }
    if (S_ISDIR(found.st_mode)) {
        throw Error("is a folder", original);
    }
    if (S_ISREG(found.st_mode) && static_cast<std::size_t>(found.st_size) > most) {
        throw Error(too_large_text(most), original);
    }
    most = S_ISREG(found.st_mode) ? most : std::min(most, largest_stream);
    std::vector<char> buffer(step_bytes);
    std::size_t total = 0;
    while (true) {
        progress.check();
        const ssize_t got = ::read(from, buffer.data(), buffer.size());
        if (got < 0 && errno != EINTR) {
            fail("cannot be read", original);
        }
        if (got == 0) {
            return total;
        }
        const auto count = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
        if (total + count > most) {
            throw Error(too_large_text(most), original);
        }
        write_all(to, buffer.data(), count, original);
        total += count;
        if (found.st_size > 0) {
            progress.report(static_cast<double>(total) / static_cast<double>(found.st_size));
        }
    }
}

} // namespace

FileSnapshot::FileSnapshot(const fs::path& file, const Progress& progress, std::size_t most) {
    const Handle from(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    if (from.number() < 0) {
        fail("cannot be opened", file);
    }
    const Handle to(nameless_file(file));
    size_ = copy(from.number(), to.number(), file, progress, most);
    if (size_ == 0) {
        return;
    }
    void* mapped = ::mmap(nullptr, size_, PROT_READ, MAP_PRIVATE, to.number(), 0);
    if (mapped == MAP_FAILED) {
        fail("cannot be mapped into memory", file);
    }
    data_ = static_cast<const char*>(mapped);
}

FileSnapshot::FileSnapshot(FileSnapshot&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileSnapshot& FileSnapshot::operator=(FileSnapshot&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

FileSnapshot::~FileSnapshot() {
    if (data_ != nullptr) {
        ::munmap(const_cast<char*>(data_), size_); // munmap only takes pointers that may be written to
    }
}

} // namespace millwright
