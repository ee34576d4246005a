// Why grids that stand beside the program's are no better than the uniform one, for the Grid workspace.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <vector>

namespace millwright::panels {

/// A note for each grid that keeps the uniform one and is not the program's, which has its own note:
/// "Elliptic, as uniform: No grid was better than the start".
[[nodiscard]] std::vector<std::string> no_gain_notes(const FrameState& now);

} // namespace millwright::panels
