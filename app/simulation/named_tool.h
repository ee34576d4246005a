// How long the flutes of the tools of `millwright simulate` are, and that each has a number of its own.
// Lengths mm.
#pragma once

#include "core/plan/named_tool.h"

#include <string>
#include <vector>

namespace millwright::app {

using plan::NamedTool;

/// Throws UsageError where two have the same number.
void expect_different_numbers(const std::vector<NamedTool>& tools);

/// Above its flutes a tool is shank, which does not cut. `texts`: [N=]LENGTH; a length for tool N wins over
/// one for all tools. Throws UsageError for two lengths of the same tool.
void take_flutes(const std::vector<std::string>& texts, std::vector<NamedTool>& tools);

} // namespace millwright::app
