// The strategy of the program's path: which points of the surface are touched, and in which order.
#pragma once

#include "ui/panels/panel.h"

#include <string>

namespace millwright::panels {

/// What the program's path takes of the grid, and over which it runs where it is not the one that was asked
/// for; a sentence or two.
[[nodiscard]] std::string grid_note(const Workbench& now);

/// Only the fields that the chosen strategy has.
void strategy_fields(Ui& ui, const Workbench& now, ActionQueue& ask);

} // namespace millwright::panels
