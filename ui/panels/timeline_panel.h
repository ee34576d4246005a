// The step-through: play, step and scrub the program, with its error and feed over the way of the tip.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/path_series.h"

#include <memory>

namespace millwright::panels {

class TimelinePanel final : public Panel {
public:
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void refresh(const Workbench& now);

    std::shared_ptr<const motion::Trajectory> trajectory_; ///< that `series_` was made of
    TrajectorySeries series_;
};

} // namespace millwright::panels
