// People say how wide a bridge is that stands; the tool leaves it narrower by its own width.
#pragma once

#include "core/plot/cut_path.h"

#include <vector>

namespace millwright::plot {

/// The levels with tabs that are wider on the way of the tool's middle by their own diameter, else by
/// `tool_diameter` (mm, >= 0), so that those of the given widths stand. Without tabs as they are.
[[nodiscard]] std::vector<Level> with_tab_widths(std::vector<Level> levels, double tool_diameter);

} // namespace millwright::plot
