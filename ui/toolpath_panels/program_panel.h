// The inspector of the Program workspace: of the project's own program feeds and clearances, what the program
// is, the block under the cursor.
#pragma once

#include "ui/panels/panel.h"
#include "ui/toolpath_panels/program_file_panel.h"

namespace millwright::panels {

class ProgramPanel final : public Panel {
public:
    explicit ProgramPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue), file_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_settings(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_summary(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_block(Ui& ui, const FrameState& now) const;

    const actions::Catalogue& catalogue_;
    ProgramFilePanel file_; ///< in its place while a G-code file is open
};

} // namespace millwright::panels
