// What is asked over everything else, one question at a time: a file, one that would be replaced, unsaved
// changes, work and jobs that a crash left behind.
#pragma once

#include "ui/panels/panel.h"
#include "ui/window/file_panel.h"
#include "ui/window/help_panel.h"
#include "ui/window/start_sheet.h"

namespace millwright::panels {

class Dialogs final : public Panel {
public:
    explicit Dialogs(const actions::Catalogue& catalogue)
        : catalogue_(catalogue), help_(catalogue), start_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_running_job(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_replacing(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_gouges(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_unsaved(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_left_behind(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_broken_job(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
    FilePanel files_;
    HelpPanel help_;
    StartSheet start_;
};

} // namespace millwright::panels
