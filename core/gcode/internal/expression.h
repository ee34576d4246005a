// Values in a line: numbers, #parameters, [expressions] and functions, with LinuxCNC's precedence
// (** before * / MOD before + - before comparisons before AND OR XOR, from the left).
#pragma once

#include "core/gcode/internal/cursor.h"
#include "core/gcode/internal/variables.h"

#include <string>

namespace millwright::gcode::internal {

/// The value at the cursor, which goes past it; always finite. Throws Refusal.
[[nodiscard]] double read_value(Cursor& cursor, const Variables& variables);

/// A value in brackets.
[[nodiscard]] double read_bracketed(Cursor& cursor, const Variables& variables);

/// What counts as whole (LinuxCNC).
inline constexpr double whole_within = 1e-4;

/// A value within `whole_within` of a whole number.
[[nodiscard]] int read_integer(Cursor& cursor, const Variables& variables);

/// A name between < and >, in lower case and without blanks; the cursor is at the <.
[[nodiscard]] std::string read_name(Cursor& cursor);

} // namespace millwright::gcode::internal
