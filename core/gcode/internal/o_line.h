// The head of a line with an O-word: its label and its keyword.
#pragma once

#include "core/gcode/internal/control_flow.h"

#include <optional>

namespace millwright::gcode::internal {

/// The keyword at the cursor, which goes past it.
[[nodiscard]] OWord read_o_keyword(Cursor& cursor);

struct OHead {
    std::string label;
    OWord word = OWord::unknown;
};

/// The head of a line that is read over: nothing where it has no O-word, or one with a computed label.
[[nodiscard]] std::optional<OHead> read_plain_o_head(Cursor& cursor);

/// Nothing but comments stands behind the cursor. `what` is for the message. Throws Refusal.
void expect_end_of_line(Cursor& cursor, std::string_view what = "an O-word");

/// A line of nothing but %.
[[nodiscard]] bool is_percent(std::string_view line);

} // namespace millwright::gcode::internal
