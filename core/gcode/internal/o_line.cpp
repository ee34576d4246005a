#include "core/gcode/internal/o_line.h"

#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/line_parser.h"

#include <fmt/format.h>

#include <array>

namespace millwright::gcode::internal {

namespace {

struct Keyword {
    std::string_view text;
    OWord word;
};

// ELSEIF before ELSE, which begins it.
constexpr std::array<Keyword, 15> keywords{{
    {"SUB", OWord::sub},
    {"ENDSUB", OWord::endsub},
    {"CALL", OWord::call},
    {"DO", OWord::do_},
    {"WHILE", OWord::while_},
    {"REPEAT", OWord::repeat},
    {"IF", OWord::if_},
    {"ELSEIF", OWord::elseif},
    {"ELSE", OWord::else_},
    {"ENDIF", OWord::endif},
    {"BREAK", OWord::break_},
    {"CONTINUE", OWord::continue_},
    {"ENDWHILE", OWord::endwhile},
    {"ENDREPEAT", OWord::endrepeat},
    {"RETURN", OWord::return_},
}};

void skip_line_number(Cursor& cursor) {
    static_cast<void>(cursor.take('/'));
    if (cursor.take('N')) {
        while (is_digit(cursor.peek()) || cursor.peek() == '.') {
            cursor.advance();
        }
    }
}

/// As std::to_string writes the number: without zeros before it.
std::string plain_number(Cursor& cursor) {
    std::string digits;
    for (char c = cursor.peek(); is_digit(c); c = cursor.peek()) {
        if (!(digits.empty() && c == '0')) {
            digits += c;
        }
        cursor.advance();
    }
    return digits.empty() ? "0" : digits;
}

} // namespace

OWord read_o_keyword(Cursor& cursor) {
    const char c = cursor.peek();
    if (cursor.at_end() || c == '(' || c == ';') {
        return OWord::bare;
    }
    for (const Keyword& keyword : keywords) {
        if (cursor.take_word(keyword.text)) {
            return keyword.word;
        }
    }
    return OWord::unknown;
}

std::optional<OHead> read_plain_o_head(Cursor& cursor) {
    skip_line_number(cursor);
    if (!cursor.take('O')) {
        return std::nullopt;
    }
    OHead head;
    const char c = cursor.peek();
    if (c == '<') {
        head.label = read_name(cursor);
    } else if (is_digit(c)) {
        head.label = plain_number(cursor);
    } else {
        return std::nullopt;
    }
    head.word = read_o_keyword(cursor);
    return head;
}

void expect_end_of_line(Cursor& cursor, std::string_view what) {
    while (cursor.peek() == '(') {
        static_cast<void>(read_comment(cursor));
    }
    if (!cursor.at_end() && cursor.peek() != ';') {
        refuse(cursor.column(), fmt::format("only a comment may follow {}", what));
    }
}

bool is_percent(std::string_view line) {
    Cursor cursor(line);
    return cursor.take('%') && cursor.at_end();
}

} // namespace millwright::gcode::internal
