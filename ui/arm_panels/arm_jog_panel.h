// Moving the arm by hand, held to run: by joints, or the tip along axes of the base or of the tool. What is
// connected moves; without a machine the drawn arm does. Keys as in Saengsasri, Nittayachin 1996: 1 to 5
// choose a joint, + and - jog it as long as they are held, / stops, H homes, K takes the power away, Q ends a
// program, S sends one, R runs it, I loads settings, X gives the keys back, : goes to the terminal.
#pragma once

#include "ui/machine_panels/connection_panel.h"
#include "ui/panels/panel.h"

#include <string>

namespace millwright::panels {

class ArmJogPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit ArmJogPanel(const actions::Catalogue& catalogue)
        : catalogue_(catalogue), connection_(catalogue) {}

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    class Wish;
    void draw_buttons(Ui& ui, const FrameState& now, Wish& wish) const;
    void draw_speed(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_power(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void stop_all(const FrameState& now, ActionQueue& ask) const;
    void obey_keys(Ui& ui, const FrameState& now, ActionQueue& ask, Wish& wish);

    const actions::Catalogue& catalogue_;
    ConnectionPanel connection_;
    int key_joint_ = 0;   ///< that + and - moved when they went down
    std::string refusal_; ///< why the last jog was not done
};

} // namespace millwright::panels
