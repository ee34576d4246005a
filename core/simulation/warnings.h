// What a person should know of a simulation although nothing is wrong with what it found.
#pragma once

#include "core/base/error.h"
#include "core/simulation/simulation.h"

#include <span>
#include <vector>

namespace millwright::simulation {

/// Feeds that were skipped, with the first one's line; a tool that is narrower than two lines of the field;
/// no move in the stock. `resolution` is the longest edge of a cell, mm. Places have no file.
[[nodiscard]] std::vector<Diagnostic>
warnings_of(const Simulation& found, std::span<const ToolUse> tools, double resolution);

/// Shank or holder goes through material.
[[nodiscard]] bool is_in_stock(const Finding& finding);

} // namespace millwright::simulation
