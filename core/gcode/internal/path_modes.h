// G61, G61.1 and G64: how closely the programmed path is kept.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

void set_path_mode(Run& run, const Block& block, int code);

/// For a canned cycle: exact path, and back to what was in force.
void go_exactly(Run& run);
void go_as_before(Run& run);

} // namespace millwright::gcode::internal
