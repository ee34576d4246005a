#include "ui/actions/shown_grid.h"

namespace millwright::actions {

project::GridMethod shown_grid(const Workbench& now) {
    return now.evaluation(now.session.shown) ? now.session.shown : project::GridMethod::uniform;
}

bool is_so_far(const project::Evaluation& evaluation) {
    return evaluation.outcome.status == grid::ImproverStatus::running;
}

} // namespace millwright::actions
