// The inspector's part for one patch of the design as a whole: its degree, and where it is split in two.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

/// The patch that the inspector shows: that of the selected control point, else the machined one.
[[nodiscard]] int edited_patch(const FrameState& now);

class PatchFields {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask);

private:
    void draw_split(Ui& ui, ActionQueue& ask, int patch);

    double split_at_ = 0.5;
};

} // namespace millwright::panels
