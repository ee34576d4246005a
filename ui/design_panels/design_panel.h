// The inspector of the Design workspace: where the surface came from, the patch, the selected control
// point, the whole net.
#pragma once

#include "ui/design_panels/patch_fields.h"
#include "ui/panels/panel.h"

#include <optional>

namespace millwright::panels {

class DesignPanel final : public Panel {
public:
    explicit DesignPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_surface(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_turn(Ui& ui, ActionQueue& ask);
    void draw_point(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_net(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_net_row(Ui& ui, const FrameState& now, ActionQueue& ask, int row, int columns);
    void draw_columns(Ui& ui, const FrameState& now, const geometry::ControlNet& net, int shown);

    const actions::Catalogue& catalogue_;
    PatchFields patch_;
    double turn_deg_ = 90.0;
    int shown_coordinate_ = 2; ///< x, y, z or weight in the table of the net
    int first_column_ = 0;     ///< of the table, where the net has more than have room
    std::optional<viewport::ControlPointId> followed_; ///< the selected point whose column was brought there
};

} // namespace millwright::panels
