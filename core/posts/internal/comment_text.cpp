#include "core/posts/internal/comment_text.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace millwright::posts::internal {

namespace {

char safe(char c, const CommentFormat& format) {
    if (c == '(') {
        return '[';
    }
    if (c == ')') {
        return ']';
    }
    const char shown = c >= ' ' && c <= '~' ? c : '?';
    return format.forbidden.find(shown) == std::string::npos ? shown : '.';
}

/// One character for each outside of ASCII, however many bytes it has in UTF-8.
std::string ascii(std::string_view text, const CommentFormat& format) {
    std::string result;
    for (const char c : text) {
        const bool continues = (static_cast<unsigned char>(c) & 0xC0U) == 0x80U;
        if (!continues) {
            const char shown = safe(c == '\n' || c == '\t' ? ' ' : c, format);
            const int upper = std::toupper(static_cast<unsigned char>(shown));
            result += format.upper_case ? static_cast<char>(upper) : shown;
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
std::size_t line_length(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) {
        return text.size();
    }
    const std::size_t space = text.rfind(' ', longest);
    return space == std::string_view::npos || space == 0 ? longest : space;
}

} // namespace

std::vector<std::string> comment_lines(std::string_view text, const CommentFormat& format) {
    constexpr std::string_view harmless = "- ";
    const std::size_t around = format.open.size() + format.close.size() + harmless.size();
    const std::size_t longest = static_cast<std::size_t>(format.longest) - around;
    const std::string clean = ascii(text, format);
    std::string_view rest = clean;
    std::vector<std::string> lines;
    do {
        const std::size_t length = line_length(rest, longest);
        const std::string_view part = rest.substr(0, length);
        lines.push_back(format.open + std::string(does_something(part) ? harmless : "") + std::string(part) +
                        format.close);
        rest.remove_prefix(length);
        rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    } while (!rest.empty());
    return lines;
}

} // namespace millwright::posts::internal
