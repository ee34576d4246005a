// Constants of the thesis's machine (its dialog Tool Set) as fields of the Toolpath workspace.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// e, OF, AB, B4, and back to those of the machine file; nothing on a machine that is built otherwise.
void tool_set_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
