// Moving a connected machine by hand: its position with the zeros, and the jog. What cannot be done is
// refused with a reason.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::panels {

class ManualPanel final : public Panel {
public:
    explicit ManualPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_position(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_jog(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_hands(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
    std::vector<double> pad_before_; ///< of each axis in the last frame
};

} // namespace millwright::panels
