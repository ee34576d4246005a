// Where a move ends, and how long it is.
#pragma once

#include "core/gcode/internal/block.h"
#include "core/gcode/modal_state.h"

namespace millwright::gcode::internal {

/// The end of the block's move in the active coordinate system: absolute, incremental, polar, or in machine
/// coordinates (G53). Axes without a word stay where they are, or were programmed. Throws Refusal.
[[nodiscard]] AxisValues end_of_move(const Block& block, const ModalState& state);

/// What an inverse-time feed refers to: the way of X Y Z; if they stand, of U V W; else of A B C.
[[nodiscard]] double straight_length(const AxisValues& from, const AxisValues& to);

} // namespace millwright::gcode::internal
