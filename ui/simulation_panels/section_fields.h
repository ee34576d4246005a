// The plane across what a simulation has left.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// On, along which axis, where, and which side stays. The place is within the stock of the last result.
void section_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
