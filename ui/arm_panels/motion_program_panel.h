// The motion program of the arm's card: written, looked through line by line, simulated, sent and run.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/text_editor.h"

namespace millwright::panels {

class MotionProgramPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit MotionProgramPanel(const actions::Catalogue& catalogue);

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    const actions::Catalogue& catalogue_;
    TextEditor editor_;
};

} // namespace millwright::panels
