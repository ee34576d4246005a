#include "core/gcode/tool_table.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/gcode/program_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace millwright::gcode {

namespace {

constexpr int largest_number = 99999;
constexpr double largest_length = 1e9; // as the words of a program

/// One line of the file and its position.
struct Line {
    std::string_view text;
    std::string_view all;
    int number = 0;
    const std::filesystem::path* file = nullptr;

    [[noreturn]] void refuse(const char* at, std::string message) const {
        Diagnostic found;
        found.place = {*file, number, static_cast<int>(at - all.data()) + 1, -1};
        found.message = std::move(message);
        throw Error(std::move(found));
    }
};

char upper(char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}

double number_of(Line& line) {
    const char* begin = line.text.data();
    const char* end = begin + line.text.size();
    if (begin != end && *begin == '+') {
        ++begin;
    }
    double value = 0.0;
    const auto read = std::from_chars(begin, end, value);
    if (read.ec != std::errc{} || !(std::abs(value) <= largest_length)) {
        line.refuse(line.text.data(), "a number is expected");
    }
    line.text.remove_prefix(static_cast<std::size_t>(read.ptr - line.text.data()));
    return value;
}

int whole_number(const Line& line, const char* at, double value) {
    const bool whole = value >= 0.0 && value <= largest_number && value - std::floor(value) <= 0.0;
    if (!whole) {
        line.refuse(at, fmt::format("an integer from 0 to {} is expected", largest_number));
    }
    return static_cast<int>(value);
}

void put(Tool& tool, char letter, double value, const Line& line, const char* at) {
    const auto axis = std::find(axis_letters.begin(), axis_letters.end(), letter);
    if (axis != axis_letters.end()) {
        tool.offset[static_cast<std::size_t>(axis - axis_letters.begin())] = value;
        return;
    }
    switch (letter) {
    case 'T':
        tool.number = whole_number(line, at, value);
        break;
    case 'P':
        tool.pocket = whole_number(line, at, value);
        break;
    case 'D':
        tool.diameter = value;
        break;
    case 'I':
        tool.front_angle = value;
        break;
    case 'J':
        tool.back_angle = value;
        break;
    case 'Q':
        tool.orientation = whole_number(line, at, value);
        break;
    default:
        line.refuse(at, fmt::format("'{}' is not a valid letter in a tool table", letter));
    }
}

void skip_blanks(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r"), text.size()));
}

void read_line(ToolTable& table, Line line) {
    Tool tool;
    bool has_number = false;
    bool empty = true;
    line.text = line.text.substr(0, line.text.find(';'));
    for (skip_blanks(line.text); !line.text.empty(); skip_blanks(line.text)) {
        const char* at = line.text.data();
        const char letter = upper(line.text.front());
        line.text.remove_prefix(1);
        put(tool, letter, number_of(line), line, at);
        has_number = has_number || letter == 'T';
        empty = false;
    }
    if (empty) {
        return;
    }
    if (!has_number) {
        line.refuse(line.all.data(), "a tool needs a tool number, T");
    }
    if (table.row_of(tool.number) >= 0) {
        line.refuse(line.all.data(), fmt::format("tool {} is in the table twice", tool.number));
    }
    table.tools.push_back(tool);
}

} // namespace

int ToolTable::row_of(int number) const {
    const auto found = std::find_if(
        tools.begin(), tools.end(), [number](const Tool& tool) { return tool.number == number; });
    return found == tools.end() ? -1 : static_cast<int>(found - tools.begin()) + 1;
}

Tool& ToolTable::at_row(int row) {
    expects(row >= 1 && row <= static_cast<int>(tools.size()), "a row of the tool table exists");
    return tools[static_cast<std::size_t>(row - 1)];
}

ToolTable parse_tool_table(std::string_view text, const std::filesystem::path& file) {
    ToolTable table;
    int number = 0;
    refuse_wide_text(text, file);
    text = program_text(text);
    while (!text.empty()) {
        const std::string_view line = text.substr(0, text.find('\n'));
        read_line(table, {line, line, ++number, &file});
        text.remove_prefix(std::min(line.size() + 1, text.size()));
    }
    return table;
}

ToolTable read_tool_table(const std::filesystem::path& file) {
    return parse_tool_table(read_file(file, largest_tool_table), file);
}

} // namespace millwright::gcode
