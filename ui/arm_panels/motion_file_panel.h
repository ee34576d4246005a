// The motion file of the arm: lines and arcs of the tool, written, checked, simulated, played, and its
// result.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/text_editor.h"

namespace millwright::panels {

class MotionFilePanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit MotionFilePanel(const actions::Catalogue& catalogue);

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    const actions::Catalogue& catalogue_;
    TextEditor editor_;
};

} // namespace millwright::panels
