// The inspector of the Grid workspace: size and direction, the two ways of making the grid better, and the
// adaptation being watched.
#pragma once

#include "ui/panels/panel.h"

#include <string>

namespace millwright::panels {

class GridPanel final : public Panel {
public:
    explicit GridPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_grid(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_watched(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_methods(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_playing(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_elliptic(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_redistribution(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_tracks(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_chain(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
