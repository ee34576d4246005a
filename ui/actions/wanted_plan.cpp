#include "ui/actions/wanted_plan.h"

#include "core/plan/strategy_path.h"

#include <algorithm>

namespace millwright::actions {

namespace {

bool is_of_program(const project::Project& project, project::GridMethod method) {
    return method == plan::program_grid(project) || method == project::GridMethod::uniform;
}

/// Another grid than the program's is drawn, or stands beside it.
bool shows_compared(const Session& session, const project::Project& project) {
    const auto& beside = session.beside.method;
    return !is_of_program(project, session.shown) || (beside && !is_of_program(project, *beside));
}

/// Another path than the program's is drawn, or stands beside it.
bool shows_other_path(const Session& session, const project::Project& project) {
    const bool own_path = plan::has_own_path(project);
    return session.beside.method || (own_path && !session.own_path_shown) ||
           (!own_path && session.shown != plan::program_grid(project));
}

} // namespace

plan::Scope wanted_plan(const Session& session, const project::Project& project) {
    const bool in_grid = session.workspace == Workspace::grid;
    const bool in_toolpath = session.workspace == Workspace::toolpath;
    const bool table = session.panes.lower_shown && session.lower_tab_now() == LowerTab::compare;
    const bool compares = in_grid || in_toolpath || table || shows_compared(session, project);
    return {.comparisons = compares,
            .times = compares,
            .weight = in_grid || session.layers_now().weight,
            .cut = true,
            .compared_cuts = shows_other_path(session, project),
            .unsequenced = in_toolpath};
}

} // namespace millwright::actions
