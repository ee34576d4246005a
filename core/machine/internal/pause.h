// Where a program waits for a person, in words.
#pragma once

#include "core/gcode/listing.h"
#include "core/gcode/program.h"

#include <string>

namespace millwright::machine::internal {

/// "program stop at line 3: M0" of the pause that is block `block`; without `listing` by the block's own
/// line.
[[nodiscard]] std::string
reason_of_pause(const gcode::Program& program, const gcode::Listing* listing, int block);

} // namespace millwright::machine::internal
