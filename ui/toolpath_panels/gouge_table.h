// The blocks that bring the cutter or the holder into the part, one per line; a click goes there.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void gouge_table(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
