// The actions that show and hide the layers of the 3D view.
#pragma once

#include "ui/viewport/layer_switches.h"

#include <string>

namespace millwright::actions {

/// The id of the action that switches a layer: "view.layer_control_net".
[[nodiscard]] std::string layer_action(const viewport::LayerSwitch& which);

/// The one that shows the layers of new_view_state() again.
inline constexpr std::string_view usual_layers_action = "view.usual_layers";

} // namespace millwright::actions
