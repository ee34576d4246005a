// From text to words: one line into a Block, with its values computed.
#pragma once

#include "core/gcode/internal/block.h"
#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/variables.h"

#include <string>
#include <vector>

namespace millwright::gcode::internal {

/// A parameter that a line sets. All of a line are set at once, after it was read.
struct Assignment {
    int number = 0;   ///< 0: `name` counts
    std::string name; ///< in lower case
    double value = 0.0;
};

struct ParsedLine {
    Block block;
    std::vector<Assignment> assignments;

    void clear() {
        block.clear();
        assignments.clear();
    }
};

/// Reads the words from the cursor to the end of the line into `line`, which was cleared. Throws Refusal.
void parse_words(Cursor& cursor, const Variables& variables, ParsedLine& line);

/// The comment in parentheses at the cursor, which goes past it. Throws Refusal.
[[nodiscard]] std::string_view read_comment(Cursor& cursor);

} // namespace millwright::gcode::internal
