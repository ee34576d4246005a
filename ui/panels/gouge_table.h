// The blocks that bring the cutter or the holder into the part, one a line; a click goes there.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void gouge_table(Ui& ui, const Workbench& now, ActionQueue& ask);

} // namespace millwright::panels
