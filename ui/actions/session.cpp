#include "ui/actions/session.h"

namespace millwright::actions {

Session new_session() {
    using viewport::ViewKind;
    Session session;
    session.layers = {viewport::layers_of(ViewKind::design),
                      viewport::layers_of(ViewKind::grid),
                      viewport::layers_of(ViewKind::error),
                      viewport::layers_of(ViewKind::toolpath),
                      viewport::layers_of(ViewKind::machine),
                      viewport::layers_of(ViewKind::toolpath),
                      viewport::layers_of(ViewKind::toolpath),
                      viewport::layers_of_arm()};
    return session;
}

void fit_project(Session& session) {
    for (const Workspace where : {Workspace::design, Workspace::grid, Workspace::toolpath}) {
        session.fit_wanted_in(where) = true;
    }
    fit_program(session);
}

void fit_program(Session& session) {
    for (const Workspace where : {Workspace::program, Workspace::machine}) {
        session.fit_wanted_in(where) = true;
    }
}

void show_grid(Session& session, project::GridMethod method) {
    session.shown = method;
    session.own_path_shown = false;
}

void tell(Session& session, widgets::Severity severity, std::string text, std::string place) {
    session.log.push_back(place.empty() ? text : place + ": " + text);
    session.notices.push_back({severity, std::move(text), std::move(place), false});
}

} // namespace millwright::actions
