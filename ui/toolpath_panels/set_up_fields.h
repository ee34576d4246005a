// The inspector's part that searches the best place of the part on the table: what is looked for and where,
// the map of what it costs, and taking it.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void set_up_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

} // namespace millwright::panels
