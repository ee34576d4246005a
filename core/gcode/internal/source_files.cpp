#include "core/gcode/internal/source_files.h"

#include "core/base/error.h"
#include "core/base/file_snapshot.h"
#include "core/base/files.h"
#include "core/gcode/program_text.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <system_error>

namespace millwright::gcode::internal {

namespace {

constexpr std::size_t buffer_size = 128 * 1024;
/// A longer line is cut; every dialect refuses far shorter ones.
constexpr std::size_t longest_source_line = 64 * 1024;
constexpr std::size_t longest_skipped_line = std::size_t{16} << 20U;

} // namespace

LineSource::LineSource(std::filesystem::path file)
    : name_(std::move(file)), file_(std::fopen(name_.c_str(), "rb")) {
    if (!file_) {
        throw Error(std::string("cannot be read: ") + std::strerror(errno), name_);
    }
    std::setvbuf(file_.get(), nullptr, _IONBF, 0);
    struct stat found {};
    is_stream_ = ::fstat(::fileno(file_.get()), &found) == 0 && !S_ISREG(found.st_mode);
    buffer_.resize(buffer_size);
    data_ = at_ = end_ = buffer_.data();
}

LineSource::LineSource(std::string_view text, std::filesystem::path name)
    : name_(std::move(name)), data_(text.data()), at_(data_), end_(data_ + text.size()) {}

bool LineSource::fill() {
    if (!file_) {
        return false;
    }
    if (is_stream_ && buffer_begin_ > static_cast<std::int64_t>(largest_stream)) {
        throw Error(too_large_text(largest_stream), name_);
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

/// Reads on until the line's end is at hand, with what follows a \r: where it is, from at_.
std::size_t LineSource::find_end() {
    while (true) {
        const auto left = static_cast<std::size_t>(end_ - at_);
        const std::size_t end = end_of_line({at_, left});
        const bool whole = end < left && (at_[end] == '\n' || end + 1 < left);
        if (whole || end >= longest_source_line || !fill()) {
            return end;
        }
    }
}

bool LineSource::next(std::string_view& line) {
    cut_ = false;
    std::size_t end = find_end();
    if (buffer_begin_ + (at_ - data_) == 0) {
        const std::size_t mark = length_of_byte_order_mark({at_, end});
        at_ += mark;
        end -= mark;
    }
    const std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
    if (rest.empty()) {
        return false;
    }
    if (line_number_ == std::numeric_limits<int>::max()) {
        throw Error("has too many lines", name_);
    }
    ++line_number_;
    if (end == rest.size() && end >= longest_source_line) {
        cut_ = true;
        line = {};
        skip_rest_of_line();
        return true;
    }
    line = end == rest.size() ? without_filling(rest) : rest.substr(0, end);
    at_ += end + length_of_line_end(rest, end);
    return true;
}

void LineSource::skip_rest_of_line() {
    for (std::size_t skipped = 0;;) {
        const std::string_view rest(at_, static_cast<std::size_t>(end_ - at_));
        const std::size_t end = end_of_line(rest);
        at_ += end;
        if (end < rest.size()) {
            const std::size_t found = find_end(); // 0, with what follows it
            at_ += length_of_line_end({at_, static_cast<std::size_t>(end_ - at_)}, found);
            return;
        }
        skipped += end;
        if (skipped > longest_skipped_line) {
            throw Error("a line is longer than 16 MiB: this is not a text file", name_);
        }
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

namespace {

/// More files than this stay open in no honest program.
constexpr std::size_t most_files = 100;

/// Names become file names: they must not lead out of the folders.
bool names_a_file(const std::string& name) {
    return !name.empty() && name.front() != '.' && name.find('/') == std::string::npos &&
           name.find('\0') == std::string::npos;
}

} // namespace

SourceFiles::SourceFiles(std::unique_ptr<LineSource> program, std::vector<std::filesystem::path> folders)
    : folders_(std::move(folders)) {
    files_.push_back({std::move(program), 0});
}

bool SourceFiles::next(std::string_view& line) {
    File& file = files_[present_];
    if (!file.source->next(line)) {
        return false;
    }
    const int number = file.source->line_number();
    if (number <= file.furthest) {
        ++repeated_;
    } else {
        file.furthest = number;
    }
    return true;
}

void SourceFiles::go_to(const Bookmark& bookmark) {
    present_ = static_cast<std::size_t>(bookmark.file);
    files_[present_].source->go_to(bookmark.position);
}

bool SourceFiles::open_subroutine(const std::string& name) {
    if (!names_a_file(name)) {
        return false;
    }
    for (const std::filesystem::path& folder : folders_) {
        const std::filesystem::path path = folder / (name + ".ngc");
        const auto open = std::find_if(
            files_.begin(), files_.end(), [&](const File& file) { return file.source->name() == path; });
        if (open != files_.end()) {
            go_to({static_cast<int>(open - files_.begin()), {}});
            return true;
        }
        std::error_code ignored;
        if (std::filesystem::is_regular_file(path, ignored) && files_.size() < most_files) {
            files_.push_back({std::make_unique<LineSource>(path), 0});
            present_ = files_.size() - 1;
            return true;
        }
    }
    return false;
}

} // namespace millwright::gcode::internal
