// How tool changes of a program are made on the connected controller, and the change that waits for a person.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Nothing where no controller is connected that leaves them to this program.
void tool_change_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

/// Which tool is waited for, and what a person can do meanwhile; nothing where none is. True: it was drawn.
bool tool_change_banner(Ui& ui, const FrameState& now);

} // namespace millwright::panels
