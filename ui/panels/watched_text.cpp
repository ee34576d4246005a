#include "ui/panels/watched_text.h"

namespace millwright::panels {

WatchedLabels watched_labels(grid::ImproverStatus status) {
    if (status == grid::ImproverStatus::running) {
        return {"Best so far", "Change so far", "Axis deviation so far"};
    }
    return {"Mean error, kept", "Change", "Axis deviation, kept"};
}

std::string watched_note(const grid::ImproverState& state) {
    if (state.status == grid::ImproverStatus::running) {
        return "These figures are not the last: at its end the whole path is measured, and a grid that is "
               "worse there than the start is not kept. The change at the end can be smaller, or none.";
    }
    if (state.now.mean < state.of_best.mean) {
        return "The grid of now has less error in the mean but is not kept: its largest error, the tool axis "
               "or "
               "the gap between tracks is worse than at the start.";
    }
    return {};
}

} // namespace millwright::panels
