#include "core/gcode/internal/line_parser.h"

#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/expression.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

/// Larger coordinates, feeds and counts are taken for mistakes; below, no arithmetic here can overflow.
constexpr double largest_value = 1e9;
constexpr std::size_t most_assignments = 50;

/// A code may be off by so many thousandths of a tenth, as when it is computed (LinuxCNC).
constexpr double code_within = 0.001;

[[noreturn]] void refuse_character(Cursor& cursor) {
    const char c = cursor.at_end() ? '\0' : *cursor.position();
    if (c < ' ' || c > '~') {
        refuse(cursor.column(),
               fmt::format("byte 0x{:02X} is not valid in a program", static_cast<unsigned char>(c)));
    }
    refuse(cursor.column(), fmt::format("'{}' is not a valid word letter", c));
}

void expect_magnitude(double value, int column) {
    if (!(std::abs(value) <= largest_value)) {
        refuse(column, "a value must not exceed 1e9");
    }
}

void read_g(Cursor& cursor, const Variables& variables, Block& block, int column) {
    const double tenths = 10.0 * read_value(cursor, variables);
    const double whole = std::round(tenths);
    if (!(tenths >= 0.0 && tenths < 1000.0) || std::abs(tenths - whole) > code_within) {
        refuse(column, "a G-code must be a number from 0 to 99.9 with at most one decimal");
    }
    const int code = static_cast<int>(whole);
    const int group = group_of_g(code);
    if (group < 0) {
        refuse(column, fmt::format("{} is not supported", g_name(code)));
    }
    const auto n = static_cast<std::size_t>(group);
    const std::uint32_t bit = 1U << n;
    const bool taken = (block.g_groups & bit) != 0;
    constexpr int g80 = 800;
    if (taken && code == g80) {
        return; // beside another motion G80 means nothing
    }
    if (taken && block.g[n] != g80) {
        refuse(column,
               fmt::format("{} and {} belong to the same modal group and cannot be in the same line",
                           g_name(block.g[n]),
                           g_name(code)));
    }
    block.g_groups |= bit;
    block.g[n] = code;
    block.g_column[n] = column;
}

void read_m(Cursor& cursor, const Variables& variables, Block& block, int column) {
    const int code = read_integer(cursor, variables);
    const int group = group_of_m(code);
    if (group < 0) {
        refuse(column, fmt::format("M{} is not supported", code));
    }
    const auto n = static_cast<std::size_t>(group);
    const std::uint32_t bit = 1U << n;
    if ((block.m_groups & bit) != 0) {
        refuse(column,
               fmt::format("M{} and M{} belong to the same modal group and cannot be in the same line",
                           block.m[n],
                           code));
    }
    constexpr int most_m_codes = 4;
    if (++block.m_count > most_m_codes) {
        refuse(column, "a line may have at most four M-codes");
    }
    block.m_groups |= bit;
    block.m[n] = code;
    block.m_column[n] = column;
}

/// Words whose values are whole, or have a sign, or neither.
double read_word_value(char letter, Cursor& cursor, const Variables& variables, int column) {
    const bool whole = letter == 'H' || letter == 'L' || letter == 'T';
    double value = 0.0;
    if (whole) {
        value = read_integer(cursor, variables);
    } else if (!read_plain_number(cursor, value)) {
        value = read_value(cursor, variables);
    }
    expect_magnitude(value, column);
    const bool unsigned_word = letter == 'F' || letter == 'S' || whole;
    if (unsigned_word && value < 0.0) {
        refuse(column, fmt::format("{} must not be negative", letter));
    }
    return value;
}

void read_letter(char letter, Cursor& cursor, const Variables& variables, Block& block) {
    const int column = cursor.column();
    cursor.advance();
    if (letter == 'G') {
        read_g(cursor, variables, block, column);
        return;
    }
    if (letter == 'M') {
        read_m(cursor, variables, block, column);
        return;
    }
    if (block.has(letter)) {
        refuse(column, fmt::format("a line may have only one {} word", letter));
    }
    block.set(letter, read_word_value(letter, cursor, variables, column), column);
}

void read_polar(Cursor& cursor, const Variables& variables, Block& block) {
    const int column = cursor.column();
    const bool is_radius = cursor.peek() == '@';
    cursor.advance();
    bool& given = is_radius ? block.polar_radius : block.polar_angle;
    if (given) {
        refuse(column, "a line may have only one @ and one ^");
    }
    const double value = read_value(cursor, variables);
    expect_magnitude(value, column);
    given = true;
    (is_radius ? block.radius : block.angle) = value;
}

/// Only spindle 0 exists here, which is all of them.
void read_spindle(Cursor& cursor, const Variables& variables, Block& block) {
    const int column = cursor.column();
    cursor.advance();
    const int spindle = read_integer(cursor, variables);
    if (block.spindle_column > 0) {
        refuse(column, "a line may have only one $ word");
    }
    if (spindle != 0 && spindle != -1) {
        refuse(column, "there is only one spindle: use $0, or $-1 for all");
    }
    block.all_spindles = spindle == -1;
    block.spindle_column = column;
}

void read_assignment(Cursor& cursor, const Variables& variables, std::vector<Assignment>& assignments) {
    const int column = cursor.column();
    cursor.advance();
    Assignment assignment;
    if (cursor.peek() == '<') {
        assignment.name = read_name(cursor);
        variables.check_settable(assignment.name, column);
    } else {
        assignment.number = read_integer(cursor, variables);
        variables.check_settable(assignment.number, column);
    }
    if (!cursor.take('=')) {
        refuse(cursor.column(), "the = after the parameter is missing");
    }
    assignment.value = read_value(cursor, variables);
    if (assignments.size() == most_assignments) {
        refuse(column, fmt::format("a line may set at most {} parameters", most_assignments));
    }
    assignments.push_back(std::move(assignment));
}

/// Neither O nor N, which begin a line.
constexpr bool begins_word(char c) {
    return c >= 'A' && c <= 'Z' && c != 'N' && c != 'O';
}

} // namespace

std::string_view read_comment(Cursor& cursor) {
    const int column = cursor.column();
    const char* const text = cursor.position() + 1;
    const char* const closed = std::find(text, cursor.end(), ')');
    if (closed == cursor.end()) {
        refuse(column, "the closing ) of the comment is missing");
    }
    const char* const nested = std::find(text, closed, '(');
    if (nested != closed) {
        refuse(column + static_cast<int>(nested - text) + 1, "a comment must not contain another comment");
    }
    cursor.move_to(closed + 1);
    return {text, static_cast<std::size_t>(closed - text)};
}

void parse_words(Cursor& cursor, const Variables& variables, ParsedLine& line) {
    Block& block = line.block;
    for (char c = cursor.peek(); !cursor.at_end(); c = cursor.peek()) {
        if (begins_word(c)) {
            read_letter(c, cursor, variables, block);
        } else if (c == '(') {
            block.comment = read_comment(cursor);
            block.has_comment = true;
        } else if (c == ';') {
            return;
        } else if (c == '#') {
            read_assignment(cursor, variables, line.assignments);
        } else if (c == '@' || c == '^') {
            read_polar(cursor, variables, block);
        } else if (c == '$') {
            read_spindle(cursor, variables, block);
        } else {
            refuse_character(cursor);
        }
    }
}

} // namespace millwright::gcode::internal
