// An XYZ table that points are played to, one a period: port, speed, live read-out of three axes, jitter.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class TablePane final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit TablePane(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_choice(Ui& ui, const Workbench& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
