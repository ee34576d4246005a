// The step-through: play, step and scrub the program, with its error and feed over the way of the tip.
#pragma once

#include "ui/panels/panel.h"
#include "ui/toolpath_panels/motion_plots.h"
#include "ui/window/path_series.h"

#include <memory>

namespace millwright::panels {

class TimelinePanel final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void refresh(const FrameState& now);
    void draw_nothing(Ui& ui, const FrameState& now) const;
    void draw_file(Ui& ui, const FrameState& now, ActionQueue& ask);

    std::shared_ptr<const motion::Trajectory> trajectory_; ///< that `series_` was made of
    TrajectorySeries series_;
    MotionPlots motion_; ///< for its series of an opened file
};

} // namespace millwright::panels
