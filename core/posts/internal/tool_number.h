// The number of the tool for controls that need one beside the line that calls it: for the H of tip control,
// or with the spindle's speed.
#pragma once

#include "core/program/program.h"

#include <string_view>

namespace millwright::posts::internal {

/// The tool that `program` calls, or the one that its pauses ask the operator for; 1 if it names none.
/// Throws Error if it asks for several: tip control would keep the length of the first. `control` names it
/// there.
[[nodiscard]] int tool_number(const program::Program& program, std::string_view control);

} // namespace millwright::posts::internal
