// One pane of the window: shows the workbench and asks for actions, computes nothing. Members of panels are
// view state only (scroll, half-typed text, what is folded).
#pragma once

#include "ui/actions/action.h"
#include "ui/widgets/ui.h"

namespace millwright::panels {

using actions::ActionQueue;
using actions::Workbench;
using widgets::Ui;

class Panel {
public:
    Panel() = default;
    Panel(const Panel&) = delete;
    Panel& operator=(const Panel&) = delete;
    virtual ~Panel() = default;

    /// Into the current pane.
    virtual void draw(Ui& ui, const Workbench& now, ActionQueue& ask) = 0;
};

} // namespace millwright::panels
