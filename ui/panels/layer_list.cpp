#include "ui/panels/layer_list.h"

#include "ui/actions/layer_actions.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/menus.h"
#include "ui/workspaces/stock_workspace.h"

#include <string>

namespace millwright::panels {

void layer_rows(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    using Of = viewport::LayerSwitch::Of;
    const Of shown = now.view_state.workspace == actions::Workspace::arm ? Of::arm : Of::part;
    for (const viewport::LayerSwitch& which : viewport::layer_switches) {
        if (which.of != shown && which.of != Of::both) {
            continue;
        }
        const actions::Action& action = catalogue.find(actions::layer_action(which));
        const actions::ActionInfo& info = action.info();
        if (widgets::menu_eye(
                ui, which.id, info.title, action.is_on(now), info.tip, action.permission(now))) {
            ask.run(std::string(info.id));
        }
    }
    if (shown == Of::part) {
        const actions::Action& stock = catalogue.find("simulation.show");
        if (widgets::menu_eye(ui,
                              "stock",
                              "Remaining stock",
                              stock.is_on(now) && actions::stock_is_current(now),
                              stock.info().tip,
                              stock.permission(now))) {
            ask.run(std::string(stock.info().id));
        }
    }
    widgets::menu_line(ui);
    const actions::Action& usual = catalogue.find(actions::usual_layers_action);
    if (widgets::menu_item(ui, "usual", usual.info().title, usual.info().shortcut, usual.permission(now))) {
        ask.run(std::string(usual.info().id));
    }
    const actions::Action& colors = catalogue.find("view.colors");
    if (widgets::menu_item(
            ui, "colors", colors.info().title, colors.info().shortcut, colors.permission(now))) {
        ask.run(std::string(colors.info().id));
    }
}

void layer_button(Ui& ui,
                  const FrameState& now,
                  ActionQueue& ask,
                  const actions::Catalogue& catalogue,
                  const widgets::Point& at) {
    const widgets::Rect rest = ui.rest();
    ui.move_by(at.x - rest.x, at.y - rest.y);
    if (const auto list = widgets::menu_button(ui, "layers", widgets::icons::eye, "Show and hide layers")) {
        layer_rows(ui, now, ask, catalogue);
    }
}

} // namespace millwright::panels
