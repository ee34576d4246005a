// What a file has around its program: every reader of programs leaves it out in the same way.
#pragma once

#include "core/base/progress.h"
#include "core/base/text.h"
#include "core/program/listing.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode {

// Where the lines of a program end: at \n, \r\n or \r alone, as the files of any computer have it.

/// Where the first line of `text` ends, before its \n or \r; the length of the text if it has no end.
[[nodiscard]] inline std::size_t end_of_line(std::string_view text) {
    constexpr std::size_t piece = 256; // so that a text without \n is not searched for one from each line on
    for (std::size_t at = 0; at < text.size(); at += piece) {
        const char* const begin = text.data() + at;
        const std::size_t left = std::min(piece, text.size() - at);
        const auto* const newline = static_cast<const char*>(std::memchr(begin, '\n', left));
        const std::size_t before = newline == nullptr ? left : static_cast<std::size_t>(newline - begin);
        const auto* const carriage = static_cast<const char*>(std::memchr(begin, '\r', before));
        if (carriage != nullptr || newline != nullptr) {
            return static_cast<std::size_t>((carriage != nullptr ? carriage : newline) - text.data());
        }
    }
    return text.size();
}

/// How long the end is that stands at `end` of the text: 0 at the end of the text, else 1, or 2 of \r\n.
[[nodiscard]] inline std::size_t length_of_line_end(std::string_view text, std::size_t end) {
    if (end == text.size()) {
        return 0;
    }
    return text.substr(end, 2) == "\r\n" ? 2 : 1;
}

/// Where the line after the one that begins at `begin` begins.
[[nodiscard]] inline std::size_t next_line(std::string_view text, std::size_t begin) {
    const std::size_t end = begin + end_of_line(text.substr(begin));
    return end + length_of_line_end(text, end);
}

/// With a \n in place of each \r that stands alone: byte for byte as long, for readers that know \n and \r\n.
[[nodiscard]] inline std::string with_newlines(std::string text) {
    for (std::size_t n = 0; n < text.size(); ++n) {
        if (text[n] == '\r' && (n + 1 == text.size() || text[n + 1] != '\n')) {
            text[n] = '\n';
        }
    }
    return text;
}

// Where the lines of a long text are: any line at once, for a few bits a line.

class LineIndex {
public:
    /// Of an empty text.
    LineIndex() = default;
    /// `text` must live as long. Throws Cancelled.
    explicit LineIndex(std::string_view text, const Progress& progress = Progress());

    [[nodiscard]] std::string_view text() const { return text_; }
    /// A last line without an end counts; an empty text has none.
    [[nodiscard]] std::ptrdiff_t count() const { return count_; }
    /// Line `n`, counted from 0, without its end. Throws Defect if there is none.
    [[nodiscard]] std::string_view line(std::ptrdiff_t n) const;
    /// Where line `n` begins.
    [[nodiscard]] std::size_t begin_of(std::ptrdiff_t n) const;
    /// The line in which the byte lies, counted from 0. Throws Defect behind the end.
    [[nodiscard]] std::ptrdiff_t line_at(std::size_t byte) const;

private:
    std::string_view text_;
    std::ptrdiff_t count_ = 0;
    std::vector<std::size_t> marks_; ///< where each lines_per_mark-th line begins
};

/// How long the byte order mark of UTF-8 is with which `text` begins; 0 where there is none.
[[nodiscard]] inline std::size_t length_of_byte_order_mark(std::string_view text) {
    return text.size() - without_byte_order_mark(text).size();
}

/// `last_line`, which has no end of its own, without what fills the last block of a file: the mark of DOS for
/// the end (byte 0x1A) and zero bytes.
[[nodiscard]] constexpr std::string_view without_filling(std::string_view last_line) {
    while (!last_line.empty() && (last_line.back() == '\x1A' || last_line.back() == '\0')) {
        last_line.remove_suffix(1);
    }
    return last_line;
}

/// `bytes` without either.
[[nodiscard]] inline std::string_view program_text(std::string_view bytes) {
    return without_filling(without_byte_order_mark(bytes));
}

/// The lines of a file, each that is not empty being a block. Throws Error if there is none.
[[nodiscard]] program::Listing listing_of(std::string text, const std::filesystem::path& file);

} // namespace millwright::gcode
