// What collides along the program, one row each: line, time, bodies, depth; a click goes there.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void collision_table(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
