// The inspector of the Design workspace: where the surface came from, the patch, the selected control
// point, the whole net.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/patch_fields.h"

namespace millwright::panels {

class DesignPanel final : public Panel {
public:
    explicit DesignPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_surface(Ui& ui, const Workbench& now, ActionQueue& ask);
    void draw_point(Ui& ui, const Workbench& now, ActionQueue& ask);
    void draw_net(Ui& ui, const Workbench& now, ActionQueue& ask);

    const actions::Catalogue& catalogue_;
    PatchFields patch_;
    int shown_coordinate_ = 2; ///< x, y, z or weight in the table of the net
};

} // namespace millwright::panels
