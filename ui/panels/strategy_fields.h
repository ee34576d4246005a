// The strategy of the program's path: which points of the surface are touched, and in which order.
#pragma once

#include "ui/panels/panel.h"

#include <string>

namespace millwright::panels {

/// What the program's path takes of the grid, and over which it runs where it is not the one that was asked
/// for; a sentence or two.
[[nodiscard]] std::string grid_note(const FrameState& now);

/// What follows a note of `evaluation` whose figures are not the last ones; empty where they are.
[[nodiscard]] std::string so_far_note(const plan::Evaluation& evaluation);

/// Only the fields that the chosen strategy has.
void strategy_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
