// Plots of the motion over time: feed with what limits it, velocities of the axes.
#pragma once

#include "ui/panels/panel.h"
#include "ui/toolpath_panels/motion_series.h"

#include <memory>

namespace millwright::panels {

class MotionPlots final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

    /// Of the motion that is shown; empty without one.
    [[nodiscard]] const MotionSeries& series(const FrameState& now);

private:
    enum class Shown { feed, axes };

    std::shared_ptr<const void> source_; ///< that `series_` was made of
    MotionSeries series_;
    Shown shown_ = Shown::feed;
};

} // namespace millwright::panels
