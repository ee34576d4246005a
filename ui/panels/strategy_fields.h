// The strategy of the program's path: which points of the surface are touched, and in which order.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Only the fields that the chosen strategy has.
void strategy_fields(Ui& ui, const Workbench& now, ActionQueue& ask);

} // namespace millwright::panels
