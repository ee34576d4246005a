#include "core/plot/tab_width.h"

#include "core/base/error.h"

namespace millwright::plot {

std::vector<Level> with_tab_widths(std::vector<Level> levels, double tool_diameter) {
    expects(tool_diameter >= 0.0, "a tool has a width");
    for (Level& level : levels) {
        level.tabs.width += level.tabs.count > 0 ? level.tool_diameter.value_or(tool_diameter) : 0.0;
    }
    return levels;
}

} // namespace millwright::plot
