#include "ui/widgets/gcode_tokens.h"

#include <algorithm>
#include <cctype>

namespace millwright::widgets {

namespace {

bool is(std::string_view set, char c) {
    return set.find(c) != std::string_view::npos;
}

bool is_gcode_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_number(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || is("+-.", c);
}

template <class Wanted> std::size_t run_of(std::string_view text, std::size_t from, Wanted&& wanted) {
    while (from < text.size() && wanted(text[from])) {
        ++from;
    }
    return from;
}

/// Behind the bracket that closes the one at the beginning; the end if none does.
std::size_t behind_bracket(std::string_view text) {
    int depth = 0;
    for (std::size_t n = 0; n < text.size(); ++n) {
        depth += text[n] == '[' ? 1 : text[n] == ']' ? -1 : 0;
        if (depth == 0) {
            return n + 1;
        }
    }
    return text.size();
}

std::size_t behind(std::string_view text, char end) {
    const std::size_t found = text.find(end);
    return found == std::string_view::npos ? text.size() : found + 1;
}

/// `#12`, `##3`, `#<name>`, with a following `=`.
std::size_t parameter_length(std::string_view text) {
    std::size_t n = run_of(text, 0, [](char c) { return c == '#'; });
    if (n < text.size() && text[n] == '<') {
        n += behind(text.substr(n), '>');
    } else if (n < text.size() && text[n] == '[') {
        n += behind_bracket(text.substr(n));
    } else {
        n = run_of(text, n, is_number);
    }
    return n < text.size() && text[n] == '=' ? n + 1 : n;
}

/// `o100 while`, `o<name> call`.
std::size_t o_word_length(std::string_view text) {
    std::size_t n = 1;
    if (n < text.size() && text[n] == '<') {
        n += behind(text.substr(n), '>');
    } else {
        n = run_of(text, n, is_number);
    }
    const std::size_t keyword = run_of(text, n, is_gcode_blank);
    return keyword < text.size() && is_letter(text[keyword]) ? run_of(text, keyword, is_letter) : n;
}

CodeKind kind_of_word(char letter) {
    switch (letter) {
    case 'N':
        return CodeKind::line_number;
    case 'G':
        return CodeKind::g_word;
    case 'M':
        return CodeKind::m_word;
    case 'F':
    case 'S':
    case 'T':
    case 'H':
    case 'D':
    case 'P':
    case 'Q':
    case 'L':
    case 'E':
        return CodeKind::parameter;
    default:
        return CodeKind::axis_word;
    }
}

} // namespace

CodeToken first_token(std::string_view text) {
    if (text.empty()) {
        return {};
    }
    const char head = text.front();
    if (is_gcode_blank(head)) {
        return {run_of(text, 0, is_gcode_blank), CodeKind::blank};
    }
    if (head == '(') {
        return {behind(text, ')'), CodeKind::comment};
    }
    if (head == ';') {
        return {text.size(), CodeKind::comment};
    }
    if (head == '%' || head == '/') {
        return {1, CodeKind::line_number};
    }
    if (head == '[') {
        return {behind_bracket(text), CodeKind::expression};
    }
    if (head == '#') {
        return {parameter_length(text), CodeKind::expression};
    }
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(head)));
    if (letter == 'O') {
        return {o_word_length(text), CodeKind::o_word};
    }
    if (is_letter(head)) {
        return {run_of(text, 1, is_number), kind_of_word(letter)};
    }
    return {is_number(head) ? run_of(text, 0, is_number) : 1, CodeKind::other};
}

} // namespace millwright::widgets
