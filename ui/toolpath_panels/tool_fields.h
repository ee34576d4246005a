// The inspector's parts about what cuts: the tool, what it does to the surface, and how the machine's rotary
// axes go along the path.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

void tool_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

/// What the tool leaves on the surface and cuts too deep; nothing for a point.
void cut_fields(Ui& ui, const FrameState& now);

void sequencing_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
