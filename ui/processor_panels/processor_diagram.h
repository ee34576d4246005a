// The processor as blocks with what is in them, and the ways that data take in this clock.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// Fills `place` of the current pane. What the last clock did is lit.
void processor_diagram(Ui& ui, const FrameState& now, const widgets::Rect& place);

} // namespace millwright::panels
