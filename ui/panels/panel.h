// One pane of the window: shows the frame's state and asks for actions, computes nothing. Members of panels
// are view state only (scroll, half-typed text, what is folded).
#pragma once

#include "ui/actions/action.h"
#include "ui/widgets/ui.h"

namespace millwright::panels {

using actions::ActionQueue;
using actions::FrameState;
using widgets::Ui;

class Panel {
public:
    Panel() = default;
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    virtual ~Panel() = default;

    /// Into the current pane.
    virtual void draw(Ui& ui, const FrameState& now, ActionQueue& ask) = 0;
};

} // namespace millwright::panels
