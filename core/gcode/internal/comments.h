// Comments that do something: (MSG,) (DEBUG,) (PRINT,) (LOG,) (LOGOPEN,) (LOGAPPEND,) (LOGCLOSE) (ABORT,).
#pragma once

#include "core/gcode/internal/run.h"

#include <string_view>

namespace millwright::gcode::internal {

/// Sends a comment, or does what it says. Throws Refusal for (ABORT,) and for a parameter without its end.
void execute_comment(Run& run, std::string_view text);

} // namespace millwright::gcode::internal
