// The live table of the drives of an arm like the Motoman L-3: A1 to A5 in counts, the lengths of the linear
// ones, and between which counts each may be as the others are now.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void arm_drives(Ui& ui, const FrameState& now);

} // namespace millwright::panels
