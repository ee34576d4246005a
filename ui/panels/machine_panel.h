// The inspector of the Machine workspace: the position in big figures, the job with hold, stop and emergency
// stop, the virtual machine's speed.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class MachinePanel final : public Panel {
public:
    explicit MachinePanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_position(Ui& ui, const Workbench& now) const;
    void draw_job(Ui& ui, const Workbench& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
