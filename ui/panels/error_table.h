// Errors side by side: uniform, elliptic, optimised, always with maximum, mean, length-weighted mean, axis
// deviation and track gap together.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// One row a grid; a click shows that grid.
void error_table(Ui& ui, std::string_view id, const Workbench& now, ActionQueue& ask);

} // namespace millwright::panels
