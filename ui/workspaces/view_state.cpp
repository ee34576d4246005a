#include "ui/workspaces/view_state.h"

namespace millwright::actions {

ViewState new_view_state() {
    using viewport::ViewKind;
    ViewState view_state;
    view_state.layers = {viewport::layers_of(ViewKind::design),
                         viewport::layers_of(ViewKind::grid),
                         viewport::layers_of(ViewKind::error),
                         viewport::layers_of(ViewKind::toolpath),
                         viewport::layers_of(ViewKind::machine),
                         viewport::layers_of(ViewKind::toolpath),
                         viewport::layers_of(ViewKind::toolpath),
                         viewport::layers_of_arm()};
    return view_state;
}

void fit_project(ViewState& view_state) {
    for (const Workspace where : {Workspace::design, Workspace::grid, Workspace::toolpath}) {
        view_state.fit_wanted_in(where) = true;
    }
    fit_program(view_state);
}

void fit_program(ViewState& view_state) {
    for (const Workspace where : {Workspace::program, Workspace::machine}) {
        view_state.fit_wanted_in(where) = true;
    }
}

void show_grid(ViewState& view_state, project::GridMethod method) {
    view_state.shown = method;
    view_state.own_path_shown = false;
}

void tell(ViewState& view_state, widgets::Severity severity, std::string text, std::string place) {
    view_state.log.push_back(place.empty() ? text : place + ": " + text);
    view_state.notices.push_back({severity, std::move(text), std::move(place), false});
}

} // namespace millwright::actions
