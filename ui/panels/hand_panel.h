// Moving a connected machine by hand: its position with the zeros, and the jog. What cannot be done is
// refused with a reason.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <string_view>

namespace millwright::panels {

class HandPanel final : public Panel {
public:
    explicit HandPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;

private:
    void draw_position(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_jog(Ui& ui, const Workbench& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
