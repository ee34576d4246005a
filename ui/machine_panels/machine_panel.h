// The Machine workspace: at the left the position in big figures and the jog; in the inspector which machine,
// the job with hold and stop, and the other commands for the machine.
#pragma once

#include "ui/machine_panels/connection_panel.h"
#include "ui/machine_panels/controls_panel.h"
#include "ui/machine_panels/manual_panel.h"
#include "ui/panels/panel.h"

namespace millwright::panels {

class MachinePanel final : public Panel {
public:
    explicit MachinePanel(const actions::Catalogue& catalogue)
        : catalogue_(catalogue), connection_(catalogue), controls_(catalogue), manual_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// The position, and what moves the machine by hand.
    void draw_left(Ui& ui, const FrameState& now, ActionQueue& ask);

private:
    void draw_position(Ui& ui, const FrameState& now) const;
    void draw_job(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_mode(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_stops(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    void draw_findings(Ui& ui, const FrameState& now) const;
    void draw_progress(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
    ConnectionPanel connection_;
    ControlsPanel controls_;
    ManualPanel manual_;
};

} // namespace millwright::panels
