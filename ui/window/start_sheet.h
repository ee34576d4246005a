// What a person sees before a real machine moves: program, machine, position, extents, spindle and tool.
// Enter starts the job, Esc does not.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class StartSheet {
public:
    explicit StartSheet(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask);
    /// Nothing is asked.
    void close() { enter_was_up_ = false; }

private:
    const actions::Catalogue& catalogue_;
    bool enter_was_up_ = false; ///< since it is shown: the press that opened it does not start
};

} // namespace millwright::panels
