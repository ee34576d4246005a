// The inspector of the Toolpath workspace: which grid is shown, its error, the set-up that causes it,
// singular points.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class ToolpathPanel final : public Panel {
public:
    explicit ToolpathPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_error(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_setup(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_singular(Ui& ui, const FrameState& now) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
