// The part of the view state that the next start begins with. Never what makes something move: the keyboard
// and the gamepad start disarmed, and nothing is connected.
#pragma once

#include "core/project/window_settings.h"
#include "ui/workspaces/view_state.h"

#include <string>
#include <vector>

namespace millwright::actions {

/// `before` with what of `view_state` is kept; names that this version does not know stay.
[[nodiscard]] project::WindowSettings kept_of(const ViewState& view_state, project::WindowSettings before);

/// Into `view_state`. A sentence for each value that cannot be right, which is left as it is.
[[nodiscard]] std::vector<std::string> restore(ViewState& view_state, const project::WindowSettings& kept);

} // namespace millwright::actions
