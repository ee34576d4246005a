// What Grbl 1.1 refuses although LinuxCNC takes it. Each refusal names Grbl's own error number.
#pragma once

#include "core/gcode/internal/block.h"
#include "core/gcode/modal_state.h"

namespace millwright::gcode::internal {

/// Of a line that passed grbl_words; `state` is in force before it. Throws Refusal.
void apply_grbl_rules(const Block& block, const ModalState& state);

} // namespace millwright::gcode::internal
