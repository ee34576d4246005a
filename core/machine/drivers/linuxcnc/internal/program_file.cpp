#include "core/machine/drivers/linuxcnc/internal/program_file.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cctype>

namespace millwright::machine::linuxcnc {

namespace {

/// Without comments, blanks and line number, in capitals.
std::string bare(std::string_view line) {
    std::string text;
    bool comment = false;
    for (const char c : line) {
        if (comment) {
            comment = c != ')';
        } else if (c == ';') {
            break;
        } else if (c == '(') {
            comment = true;
        } else if (std::isspace(static_cast<unsigned char>(c)) == 0) {
            text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
    }
    if (text.starts_with('N')) {
        text.erase(0, std::min(text.find_first_not_of("0123456789.", 1), text.size()));
    }
    return text;
}

bool ends(const std::string& bare_line) {
    for (const std::string_view code : {"M30", "M2", "M02"}) {
        const std::size_t at = bare_line.find(code);
        const std::size_t next = at + code.size();
        const bool whole =
            at != std::string::npos &&
            (next == bare_line.size() || std::isdigit(static_cast<unsigned char>(bare_line[next])) == 0);
        if (whole) {
            return true;
        }
    }
    return false;
}

} // namespace

ProgramFile program_file(const gcode::Listing& listing, const std::filesystem::path& file, int number) {
    ProgramFile result;
    bool opened = false;
    for (int line = 1; line <= listing.line_count() && result.end_line == 0; ++line) {
        const std::string text = bare(listing.line(line));
        const bool flow = text.starts_with('O') || text.starts_with("M98") || text.starts_with("M99");
        result.in_order = result.in_order && !flow;
        const bool percent = text.starts_with('%');
        if (ends(text) || (percent && opened)) {
            result.end_line = line;
        }
        opened = opened || percent;
    }
    if (result.end_line == 0) {
        throw Error("the program has no end: M2, M30 or a closing %", file);
    }
    result.end_mark = fmt::format("millwright {} has executed everything", number);
    for (int line = 1; line <= listing.line_count(); ++line) {
        // A dwell waits for all motion, so that the message behind it comes after it.
        result.text += line == result.end_line ? fmt::format("G4 P0\n(MSG,{})\n", result.end_mark) : "";
        result.text += std::string(listing.line(line)) + "\n";
    }
    return result;
}

} // namespace millwright::machine::linuxcnc
