#include "core/links/file_link.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <chrono>
#include <thread>

namespace millwright::links {

void FileLink::open() {
    const std::scoped_lock lock(mutex_);
    write_file(file_, ""); // what was there may have another name, under which it stays
    out_ = std::ofstream(file_, std::ios::binary | std::ios::app);
    failed_ = false;
    if (!out_) {
        throw Error("cannot be written", file_);
    }
}

void FileLink::write(std::string_view bytes) {
    const std::scoped_lock lock(mutex_);
    if (out_.is_open() && !failed_) {
        out_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        out_.flush(); // a full disk is reported now, not when it is too late
        failed_ = !out_;
    }
}

void FileLink::wait(double seconds) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

std::optional<std::string> FileLink::lost() const {
    const std::scoped_lock lock(mutex_);
    return failed_ ? std::optional<std::string>("the file can no longer be written") : std::nullopt;
}

void FileLink::close() noexcept {
    const std::scoped_lock lock(mutex_);
    out_.close();
}

} // namespace millwright::links
