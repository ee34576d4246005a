#include "ui/actions/shown_grid.h"

namespace millwright::actions {

project::GridMethod shown_grid(const Workbench& now) {
    return now.evaluation(now.session.shown) ? now.session.shown : project::GridMethod::uniform;
}

} // namespace millwright::actions
