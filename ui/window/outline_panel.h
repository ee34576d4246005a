// The outline: the project as a tree of what is there, with how each stage stands; a click goes to its
// workspace.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class OutlinePanel final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
};

} // namespace millwright::panels
