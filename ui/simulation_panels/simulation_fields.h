// The inspector's part about the simulation of material removal: the stock, how finely and by what it is
// looked at, and what came of it.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void simulation_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

} // namespace millwright::panels
