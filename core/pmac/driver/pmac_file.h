// Files of PMAC commands (pmac.ini): what is sent of them, and what a person should know before.
#pragma once

#include "core/base/error.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac {

struct PmacFile {
    struct Line {
        int number = 0; ///< from 1
        std::string text;
    };
    std::vector<Line> lines;           ///< to be sent, in order; without blanks at their ends
    std::vector<Diagnostic> warnings;  ///< protections that are off in the end, values that will roll over
    std::vector<Diagnostic> omissions; ///< lines that are left out
    int left_out = 0;                  ///< of them, those that set nothing: what moves is no setting
};

/// Lines end with LF or CR LF, the last one with or without; ';' begins a comment. Settings of the hand-shake
/// (I1, I3, I4, I6, I9) are left out, since the driver needs its own, and so are lines that would weaken the
/// guard of the link (guard_rules.h), and lines that set nothing
/// (jogs, programs that would run, words that no card knows). Throws Error with the place of a character that
/// is no text, of a value beyond 24 bits, and of a line in a buffer that would weaken the guard.
[[nodiscard]] PmacFile read_pmac_file(std::string_view text, const std::filesystem::path& file);

/// Why a line of a motion program has no OPEN, CLOSE or CLEAR.
constexpr const char* buffer_word_hint =
    "leave it out: the buffer is opened, cleared and closed automatically";

/// The lines of a motion program or of a file with one, as they are; Error as above.
[[nodiscard]] std::vector<PmacFile::Line> read_pmac_program(std::string_view text,
                                                            const std::filesystem::path& file);

/// "ERR003" in words; empty for a number that the manual does not have.
[[nodiscard]] std::string_view pmac_error(int number);

} // namespace millwright::pmac
