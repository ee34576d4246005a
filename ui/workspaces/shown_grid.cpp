#include "ui/workspaces/shown_grid.h"

#include "core/plan/strategy_path.h"

namespace millwright::actions {

project::GridMethod shown_grid(const FrameState& now) {
    return now.evaluation(now.view_state.shown) ? now.view_state.shown : project::GridMethod::uniform;
}

void show_program_path(ViewState& view_state, const project::Project& project) {
    view_state.shown = plan::program_grid(project);
    view_state.own_path_shown = true;
}

bool is_so_far(const plan::Evaluation& evaluation) {
    return evaluation.outcome.status == grid::OptimiserStatus::running;
}

} // namespace millwright::actions
