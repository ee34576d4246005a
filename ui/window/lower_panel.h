// The lower pane: plots over the path, the listing in step with the motion, results side by side, jobs, log.
#pragma once

#include "ui/arm_panels/arm_points_panel.h"
#include "ui/arm_panels/motion_file_panel.h"
#include "ui/arm_panels/motion_program_panel.h"
#include "ui/machine_panels/console_panel.h"
#include "ui/machine_panels/controller_tables.h"
#include "ui/machine_panels/queue_panel.h"
#include "ui/panels/panel.h"
#include "ui/toolpath_panels/listing_panel.h"
#include "ui/toolpath_panels/motion_plots.h"

#include <cstdint>
#include <vector>

namespace millwright::panels {

class LowerPanel final : public Panel {
public:
    explicit LowerPanel(const actions::Catalogue& catalogue)
        : queue_(catalogue), points_(catalogue), motion_program_(catalogue), motion_file_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_plots(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_jobs(Ui& ui, const FrameState& now) const;
    void draw_log(Ui& ui, const FrameState& now) const;

    MotionPlots motion_;
    ListingPanel listing_;
    ConsolePanel console_;
    OffsetTable offsets_;
    SettingTable settings_;
    QueuePanel queue_;
    ArmPointsPanel points_;
    MotionProgramPanel motion_program_;
    MotionFilePanel motion_file_;
};

} // namespace millwright::panels
