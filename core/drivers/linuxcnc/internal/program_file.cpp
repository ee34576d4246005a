#include "core/drivers/linuxcnc/internal/program_file.h"

#include "core/base/error.h"
#include "core/drivers/stripped_line.h"

#include <fmt/format.h>

namespace millwright::drivers::linuxcnc {

namespace {

bool ends(const std::string& line) {
    return has_code(line, "M30") || has_code(line, "M2") || has_code(line, "M02");
}

} // namespace

ProgramFile program_file(const program::Listing& listing, const std::filesystem::path& file, int number) {
    ProgramFile result;
    bool opened = false;
    for (int line = 1; line <= listing.line_count() && result.end_line == 0; ++line) {
        const std::string text = stripped_line(listing.line(line));
        result.in_order = result.in_order && !is_flow(text);
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

} // namespace millwright::drivers::linuxcnc
