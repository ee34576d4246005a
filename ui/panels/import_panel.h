// What becomes of a surface of another program before it is the project's: which face, which degree, and how
// far the patch is from it. In place of the Design inspector while a file is on the import bench.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Into the current pane; a file is on the import bench.
void import_panel(Ui& ui, const Workbench& now, ActionQueue& ask, const actions::Catalogue& catalogue);

} // namespace millwright::panels
