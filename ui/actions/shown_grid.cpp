#include "ui/actions/shown_grid.h"

#include "core/plan/strategy_path.h"

namespace millwright::actions {

project::GridMethod shown_grid(const Workbench& now) {
    return now.evaluation(now.session.shown) ? now.session.shown : project::GridMethod::uniform;
}

void show_program_path(Session& session, const project::Project& project) {
    session.shown = plan::program_grid(project);
    session.own_path_shown = true;
}

bool is_so_far(const plan::Evaluation& evaluation) {
    return evaluation.outcome.status == grid::ImproverStatus::running;
}

} // namespace millwright::actions
