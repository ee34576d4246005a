// The dialog that gives layers of the 3D view colours in place of the theme's.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// For as long as OpenDialogs::colors.
void color_dialog(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
