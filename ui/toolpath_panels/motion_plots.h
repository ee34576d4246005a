// Plots of the motion over time: feed with what limits it, velocities of the axes, what a simulation cuts.
#pragma once

#include "ui/panels/panel.h"
#include "ui/simulation_panels/engagement_series.h"
#include "ui/toolpath_panels/motion_series.h"

#include <memory>

namespace millwright::panels {

class MotionPlots final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

    /// Of the motion that is shown; empty without one.
    [[nodiscard]] const MotionSeries& series(const FrameState& now);

private:
    enum class Shown { feed, axes, rate, engagement };

    /// Of the simulation, if that is of the motion that is shown; empty else.
    [[nodiscard]] const EngagementSeries& engagement(const FrameState& now);
    void draw_lines(Ui& ui, const FrameState& now, ActionQueue& ask);

    std::shared_ptr<const void> source_; ///< that `series_` was made of
    MotionSeries series_;
    std::shared_ptr<const void> cut_; ///< that `engagement_` was made of
    EngagementSeries engagement_;
    Shown shown_ = Shown::feed;
};

} // namespace millwright::panels
