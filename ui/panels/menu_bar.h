// The top bar: menus, the workspaces, search, the emergency stop, which is always in sight.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class MenuBar final : public Panel {
public:
    explicit MenuBar(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_menus(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_samples(Ui& ui, const Workbench& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
