// Errors side by side: every grid, and the path of a strategy, always with maximum, mean, length-weighted
// mean, axis deviation and track gap together, and the time on the machine.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <vector>

namespace millwright::panels {

struct ErrorRow {
    std::string id;                 ///< of the grid; "path": that of the strategy
    std::vector<std::string> cells; ///< from the name to the time, s; "-" where nothing is known
};

/// One row a grid, then the path where the project has one of its own.
[[nodiscard]] std::vector<ErrorRow> error_rows(const FrameState& now);

/// All rows; a click shows that grid. Where the pane is low the table scrolls.
void error_table(Ui& ui, std::string_view id, const FrameState& now, ActionQueue& ask);

} // namespace millwright::panels
