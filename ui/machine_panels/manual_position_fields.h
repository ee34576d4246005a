// Where a machine stands that does not tell it, as a person has read it there.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// It is connected and does not report its position, and that has not been entered, or what was entered is in
/// doubt.
[[nodiscard]] bool needs_manual_position(const actions::ConnectionView& machine);

void manual_position_fields(Ui& ui, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
