#include "core/gcode/reader/internal/line_source.h"

#include "core/base/error.h"

#include <cerrno>
#include <cstring>
#include <limits>

namespace millwright::gcode::internal {

namespace {

constexpr std::size_t buffer_size = 128 * 1024;
/// A longer line is cut; every dialect refuses far shorter ones.
constexpr std::ptrdiff_t longest_line = 64 * 1024;

} // namespace

LineSource::LineSource(std::filesystem::path file)
    : name_(std::move(file)), file_(std::fopen(name_.c_str(), "rb")) {
    if (!file_) {
        throw Error(std::string("cannot be read: ") + std::strerror(errno), name_);
    }
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    buffer_.resize(buffer_size);
    data_ = at_ = end_ = buffer_.data();
}

LineSource::LineSource(std::string_view text, std::filesystem::path name)
    : name_(std::move(name)), data_(text.data()), at_(data_), end_(data_ + text.size()) {}

bool LineSource::fill() {
    if (!file_) {
        return false;
    }
    const auto left = static_cast<std::size_t>(end_ - at_);
    std::memmove(buffer_.data(), at_, left);
    buffer_begin_ += at_ - data_;
    errno = 0;
    const std::size_t read = std::fread(buffer_.data() + left, 1, buffer_.size() - left, file_.get());
    if (std::ferror(file_.get()) != 0) {
        throw Error(std::string("cannot be read: ") + std::strerror(errno), name_);
    }
    at_ = data_;
    end_ = data_ + left + read;
    return read > 0;
}

bool LineSource::next(std::string_view& line) {
    const auto find_end = [this] {
        return at_ == end_
                   ? nullptr
                   : static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    };
    cut_ = false;
    const char* newline = find_end();
    while (newline == nullptr && end_ - at_ < longest_line && fill()) {
        newline = find_end();
    }
    if (newline == nullptr && at_ == end_) {
        return false;
    }
    if (line_number_ == std::numeric_limits<int>::max()) {
        throw Error("has too many lines", name_);
    }
    ++line_number_;
    const char* const stop = newline == nullptr ? end_ : newline;
    line = {at_, static_cast<std::size_t>(stop - at_)};
    at_ = stop;
    if (newline != nullptr) {
        ++at_;
    } else if (stop - line.data() >= longest_line) {
        cut_ = true;
        line = {};
        skip_rest_of_line();
    }
    return true;
}

void LineSource::skip_rest_of_line() {
    for (;;) {
        const auto left = static_cast<std::size_t>(end_ - at_);
        const void* newline = left == 0 ? nullptr : std::memchr(at_, '\n', left);
        if (newline != nullptr) {
            at_ = static_cast<const char*>(newline) + 1;
            return;
        }
        at_ = end_;
        if (!fill()) {
            return;
        }
    }
}

void LineSource::go_to(const Position& position) {
    line_number_ = position.line;
    const std::int64_t offset = position.byte - buffer_begin_;
    if (offset >= 0 && offset <= end_ - data_) {
        at_ = data_ + offset;
        return;
    }
    expects(file_ != nullptr, "a place in a text lies inside of it");
    if (fseeko(file_.get(), position.byte, SEEK_SET) != 0) {
        throw Error(std::string("cannot be read again: ") + std::strerror(errno), name_);
    }
    buffer_begin_ = position.byte;
    at_ = end_ = data_;
}

} // namespace millwright::gcode::internal
