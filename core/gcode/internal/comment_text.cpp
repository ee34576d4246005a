#include "core/gcode/internal/comment_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace millwright::gcode::internal {

namespace {

char safe(char c) {
    if (c == '(') {
        return '[';
    }
    if (c == ')') {
        return ']';
    }
    return c >= ' ' && c <= '~' ? c : '?';
}

/// One '?' for each character outside of ASCII, however many bytes it has in UTF-8.
std::string ascii(std::string_view text) {
    std::string result;
    for (const char c : text) {
        const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
        if (!continues) {
            result += safe(c == '\n' || c == '\t' ? ' ' : c);
        }
    }
    return result;
}

bool does_something(std::string_view comment) {
    constexpr std::array<std::string_view, 7> active{"msg", "debug", "print", "log", "probe", "abort", "py"};
    std::string word;
    for (const char c : comment) {
        if (c != ' ') {
            word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        }
    }
    return std::any_of(active.begin(), active.end(), [&](std::string_view name) {
        return word.compare(0, name.size(), name) == 0;
    });
}

/// How much of `text` goes into one line: up to a space if there is one.
std::size_t line_length(std::string_view text) {
    constexpr std::size_t longest = 96;
    if (text.size() <= longest) {
        return text.size();
    }
    const std::size_t space = text.rfind(' ', longest);
    return space == std::string_view::npos || space == 0 ? longest : space;
}

} // namespace

std::vector<std::string> comment_lines(std::string_view text) {
    const std::string clean = ascii(text);
    std::string_view rest = clean;
    std::vector<std::string> lines;
    do {
        const std::size_t length = line_length(rest);
        const std::string_view part = rest.substr(0, length);
        lines.push_back((does_something(part) ? "(- " : "(") + std::string(part) + ")");
        rest.remove_prefix(length);
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    } while (!rest.empty());
    return lines;
}

} // namespace millwright::gcode::internal
