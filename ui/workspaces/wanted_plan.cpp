#include "ui/workspaces/wanted_plan.h"

#include "core/plan/strategy_path.h"

#include <algorithm>

namespace millwright::actions {

namespace {

bool is_of_program(const project::Project& project, project::GridMethod method) {
    return method == plan::program_grid(project) || method == project::GridMethod::uniform;
}

/// Another grid than the program's is drawn, or stands beside it.
bool shows_compared(const ViewState& view_state, const project::Project& project) {
    const auto& compared = view_state.compare_with.method;
    return !is_of_program(project, view_state.shown) || (compared && !is_of_program(project, *compared));
}

/// Another path than the program's is drawn, or stands beside it.
bool shows_other_path(const ViewState& view_state, const project::Project& project) {
    const bool own_path = plan::has_own_path(project);
    return view_state.compare_with.method || (own_path && !view_state.own_path_shown) ||
           (!own_path && view_state.shown != plan::program_grid(project));
}

} // namespace

plan::Scope wanted_plan(const ViewState& view_state, const project::Project& project) {
    const bool in_grid = view_state.workspace == Workspace::grid;
    const bool in_toolpath = view_state.workspace == Workspace::toolpath;
    const bool table = view_state.panes.lower_shown && view_state.lower_tab_now() == LowerTab::compare;
    const bool compares = in_grid || in_toolpath || table || shows_compared(view_state, project);
    return {.compared = {.grids = compares, .cuts = shows_other_path(view_state, project)},
            .times = compares,
            .weight = in_grid || view_state.layers_now().colored.weight,
            .cut = true,
            .unsequenced = in_toolpath};
}

} // namespace millwright::actions
