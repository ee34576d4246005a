// The lower pane: plots over the path, the listing in step with the motion, results side by side, jobs, log.
#pragma once

#include "ui/panels/panel.h"

#include <cstdint>
#include <vector>

namespace millwright::panels {

class LowerPanel final : public Panel {
public:
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_plots(Ui& ui, const Workbench& now, ActionQueue& ask);
    void draw_listing(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_jobs(Ui& ui, const Workbench& now) const;
    void draw_log(Ui& ui, const Workbench& now) const;
};

} // namespace millwright::panels
