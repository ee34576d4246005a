// The inspector's part about the project's path on the arm: where its part stands, and how far the arm
// reaches.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void arm_path_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

} // namespace millwright::panels
