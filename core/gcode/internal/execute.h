// One line after it was read: its codes in the order in which LinuxCNC executes them.
#pragma once

#include "core/gcode/internal/line_parser.h"
#include "core/gcode/internal/run.h"

#include <string_view>

namespace millwright::gcode::internal {

/// Checks and executes `line`. Throws Refusal.
void execute_line(Run& run, ParsedLine& line);

/// Executes words that stand in no program.
void execute_text(Run& run, std::string_view words);

} // namespace millwright::gcode::internal
