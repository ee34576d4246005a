// A program's text as the lines that Grbl is sent, and what can be said of them without executing them.
#pragma once

#include "core/program/listing.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers::grbl {

struct ProgramLine {
    std::string text;           ///< without blanks, comments and N word, in capitals, without its end
    int block = 0;              ///< of the listing
    int line = 0;               ///< of its text, from 1
    bool surely_moves = false;  ///< Grbl makes at least one planner block of it
    double dwell = 0.0;         ///< s, of a G4
    bool writes_eeprom = false; ///< Grbl loses what it is sent meanwhile
    bool moves_zero = false;    ///< it may change the work offset
    int stop = -1;              ///< of ToolChanges::stops: the program stops before it; -1: it does not

    [[nodiscard]] bool is_setting() const { return text.starts_with('$'); }
    /// Nothing is sent from before it until its answer: what follows would be lost.
    [[nodiscard]] bool goes_alone() const { return writes_eeprom || text == "$C"; }
};

struct ProgramLines {
    std::vector<ProgramLine> lines; ///< those with nothing to do are left out
    int blocks = 0;                 ///< of the listing

    /// Blocks that are done when the first `count` lines are.
    [[nodiscard]] int blocks_before(int count) const;
};

/// Throws Error naming `file`, line and column for what Grbl must not be sent within a program: characters
/// that it takes for real-time commands or does not know, $ commands, lines of more than `longest`
/// characters.
[[nodiscard]] ProgramLines
program_lines(const program::Listing& listing, const std::filesystem::path& file, std::size_t longest = 79);

/// Lines that a person types: G-code as above, or $ commands that set nothing in motion and need no stage of
/// their own: settings, questions, startup lines. Throws Error naming line and column for others.
[[nodiscard]] ProgramLines command_lines(std::string_view text, std::size_t longest = 79);

} // namespace millwright::drivers::grbl
