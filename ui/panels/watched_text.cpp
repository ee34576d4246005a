#include "ui/panels/watched_text.h"

namespace millwright::panels {

WatchedLabels watched_labels(grid::OptimiserStatus status) {
    if (status == grid::OptimiserStatus::running) {
        return {"Best so far", "Change so far", "Axis dev. so far"};
    }
    return {"Mean error, kept", "Change", "Axis dev., kept"};
}

std::string watched_note(const grid::OptimiserState& state) {
    if (state.status == grid::OptimiserStatus::running) {
        return "These values are not final: the whole path is measured at the end, and a grid that is then "
               "worse than the start grid is not kept. The final change can be smaller, or none.";
    }
    if (state.now.mean < state.of_best.mean) {
        return "The current grid has a smaller mean error but is not kept: its largest error, tool axis "
               "deviation or track gap is worse than at the start.";
    }
    return {};
}

} // namespace millwright::panels
