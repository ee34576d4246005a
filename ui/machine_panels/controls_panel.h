// The other commands for a connected machine: homing and probing, overrides, spindle and coolant.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class ControlsPanel final : public Panel {
public:
    explicit ControlsPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_finding(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_overrides(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_spindle(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
