// The points that were taught to the arm: named, put in order, changed, played.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class ArmPointsPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit ArmPointsPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_chosen(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_table(Ui& ui, const FrameState& now);
    void swap_with(ActionQueue& ask, int other);

    const actions::Catalogue& catalogue_;
    int chosen_ = -1; ///< row
};

} // namespace millwright::panels
