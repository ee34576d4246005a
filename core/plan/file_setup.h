// What a G-code file needs to be simulated, which has neither stock nor tools in it. Lengths mm.
#pragma once

#include "core/plan/opened_program.h"
#include "core/plan/stock_simulation.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

/// Shapes by the number of T, as core/simulation/spec_text.h has them; 0: of a program that calls no tool.
using ToolTexts = std::map<int, std::string>;

/// Each tool that the program calls, by its first call, in the order of these. Of a program that calls none,
/// one with number 0 and line 0. Empty where there is no motion, or no simulation of it.
[[nodiscard]] std::vector<gcode::ToolCall> called_tools(const OpenedProgram& opened);

/// A box around what the feeds reach, in whole mm: down to 1 mm below them, 1 mm more on every side, up to
/// the highest feed, and to Z 0 where that is above. Empty if there is no feed.
[[nodiscard]] std::string suggested_stock(const OpenedProgram& opened);

/// The first tool whose shape is not there, with the line that calls it.
[[nodiscard]] std::optional<Diagnostic> missing_tool(const OpenedProgram& opened, const ToolTexts& tools);

/// Throws Error, with the line, for a tool whose shape is not there or is wrong, and for what cannot be
/// simulated. No other tool is taken in place of a missing one.
[[nodiscard]] FileSetup file_setup(const OpenedProgram& opened, const ToolTexts& tools);

} // namespace millwright::plan
