// M70 to M73: the modal state of a subroutine, kept and brought back.
#pragma once

#include "core/gcode/internal/run.h"

namespace millwright::gcode::internal {

/// M70 saves, M71 forgets, M72 brings back, M73 saves until the subroutine returns.
void execute_saved_modes(Run& run, const Block& block, int code);

/// Makes what was in force in `saved` be in force again, by the codes that do so.
void restore_modes(Run& run, const SavedModes& saved);

} // namespace millwright::gcode::internal
