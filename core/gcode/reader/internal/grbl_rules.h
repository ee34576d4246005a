// What Grbl 1.1 refuses although LinuxCNC takes it. Each refusal names Grbl's own error number.
#pragma once

#include "core/gcode/reader/internal/block.h"
#include "core/gcode/reader/modal_state.h"

#include <string_view>

namespace millwright::gcode::internal {

/// Refuses expressions, parameters, O-words and lines that are too long. Throws Refusal.
void check_grbl_text(std::string_view line);

/// Refuses codes and words; `state` is in force before the line. Throws Refusal.
void apply_grbl_rules(const Block& block, const ModalState& state);

} // namespace millwright::gcode::internal
