// Beginning a job at a line: which, how high the tool comes from, and what the machine does before it.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void start_line_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
