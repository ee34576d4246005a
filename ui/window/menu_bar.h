// The top bar: menus, the workspaces, what is wanted often, search.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class MenuBar final : public Panel {
public:
    explicit MenuBar(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_menus(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_submenu(Ui& ui,
                      const FrameState& now,
                      ActionQueue& ask,
                      std::string_view id,
                      std::string_view label,
                      bool (*holds)(std::string_view action_id)) const;
    void draw_files(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_tools(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
