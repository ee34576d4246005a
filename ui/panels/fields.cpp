#include "ui/panels/fields.h"

#include <algorithm>

namespace millwright::panels {

void action_button(Ui& ui,
                   const FrameState& now,
                   ActionQueue& ask,
                   const actions::Catalogue& catalogue,
                   std::string_view action_id,
                   widgets::Rank rank,
                   std::string_view label) {
    const actions::Action& action = catalogue.find(action_id);
    const actions::ActionInfo& info = action.info();
    std::string id(info.id);
    std::replace(id.begin(), id.end(), '.', '_');
    const widgets::ButtonLook look{info.icon, rank, -1.0F, info.tip};
    if (ui.button(id, label.empty() ? info.title : label, action.permission(now), look)) {
        ask.run(std::string(info.id));
    }
}

} // namespace millwright::panels
