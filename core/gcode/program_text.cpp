#include "core/gcode/program_text.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace millwright::gcode {

namespace {

constexpr std::ptrdiff_t lines_per_mark = 64;
constexpr std::ptrdiff_t lines_per_check = 65'536;

} // namespace

LineIndex::LineIndex(std::string_view text, const Progress& progress) : text_(text) {
    std::size_t begin = 0;
    while (begin < text.size()) {
        if (count_ % lines_per_mark == 0) {
            marks_.push_back(begin);
        }
        if (count_ % lines_per_check == 0) {
            progress.check();
            progress.report(static_cast<double>(begin) / static_cast<double>(text.size()));
        }
        ++count_;
        begin = next_line(text, begin);
    }
}

std::size_t LineIndex::begin_of(std::ptrdiff_t n) const {
    expects(n >= 0 && n < count_, "a line of the text");
    std::size_t begin = marks_[static_cast<std::size_t>(n / lines_per_mark)];
    for (std::ptrdiff_t k = n % lines_per_mark; k > 0; --k) {
        begin = next_line(text_, begin);
    }
    return begin;
}

std::string_view LineIndex::line(std::ptrdiff_t n) const {
    const std::size_t begin = begin_of(n);
    const std::string_view rest = text_.substr(begin);
    return rest.substr(0, end_of_line(rest));
}

std::ptrdiff_t LineIndex::line_at(std::size_t byte) const {
    expects(byte < text_.size(), "a byte of the text");
    const auto after = std::upper_bound(marks_.begin(), marks_.end(), byte);
    std::ptrdiff_t n = (after - marks_.begin() - 1) * lines_per_mark;
    std::size_t end = next_line(text_, *(after - 1));
    while (end <= byte) {
        end = next_line(text_, end);
        ++n;
    }
    return n;
}

program::Listing listing_of(std::string text, const std::filesystem::path& file) {
    program::Listing listing;
    text = with_newlines(std::string(program_text(text)));
    if (!text.empty() && text.back() != '\n') {
        text += '\n';
    }
    listing.text = std::move(text);
    listing.line_starts.push_back(0);
    for (std::size_t n = 0; n < listing.text.size(); ++n) {
        if (listing.text[n] != '\n') {
            continue;
        }
        const std::string_view line =
            std::string_view(listing.text).substr(listing.line_starts.back(), n - listing.line_starts.back());
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) {
            listing.line_of_block.push_back(static_cast<int>(listing.line_starts.size()));
        }
        listing.line_starts.push_back(n + 1);
    }
    if (listing.line_of_block.empty()) {
        throw Error(Diagnostic{{file, 1, 1, -1}, "the program is empty", {}});
    }
    return listing;
}

} // namespace millwright::gcode
