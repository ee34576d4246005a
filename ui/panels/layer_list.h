// Shows and hides the layers of the 3D view: the same rows in a menu and at the view's corner.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// The rows of an open menu: an eye a layer, and below them the way back.
void layer_rows(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue);

/// The button that opens them, its upper left corner at `at`.
void layer_button(Ui& ui,
                  const FrameState& now,
                  ActionQueue& ask,
                  const actions::Catalogue& catalogue,
                  const widgets::Point& at);

} // namespace millwright::panels
