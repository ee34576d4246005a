// The live table of an arm: where each joint stands, how fast it moves, and what its limits are.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void arm_motors(Ui& ui, const FrameState& now);

} // namespace millwright::panels
