// Where the lines of a program end: at \n, \r\n or \r alone, as the files of any computer have it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string>
#include <string_view>

namespace millwright::gcode {

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

} // namespace millwright::gcode
