// The status bar: what runs in the background with a bar and Cancel, the machine's state, units, the mouse.
#pragma once

#include "core/geometry/vectors.h"
#include "ui/panels/panel.h"

#include <optional>

namespace millwright::panels {

/// `under_mouse`: the surface point under the mouse in workpiece coordinates, mm.
void status_bar(Ui& ui, const FrameState& now, ActionQueue& ask, const std::optional<Vec3>& under_mouse);

} // namespace millwright::panels
