// What must and must not stand together in one line, and which motion the line makes.
#pragma once

#include "core/gcode/internal/block.h"
#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"

namespace millwright::gcode::internal {

/// Finds the line's motion (Block::motion) and checks its words against its codes, as LinuxCNC does before it
/// executes anything. Throws Refusal.
void apply_word_rules(Block& block, const ModalState& state, Dialect dialect);

} // namespace millwright::gcode::internal
