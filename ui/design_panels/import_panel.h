// What becomes of a surface of another program before it is the project's: which face, which degree, and how
// far the patch is from it. In place of the Design inspector while an import is pending.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Into the current pane; an import is pending.
void import_panel(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

} // namespace millwright::panels
