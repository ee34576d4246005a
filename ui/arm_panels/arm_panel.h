// The Arm workspace's inspector: which arm, its joints, its tool, the goal with every way to reach it.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <vector>

namespace millwright::panels {

class ArmPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit ArmPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// Below the view: what moves, and how far it is.
    void draw_motion(Ui& ui, const FrameState& now, ActionQueue& ask) const;

private:
    void draw_arm(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_joints(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_tool(Ui& ui, const FrameState& now) const;
    void draw_goal(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_solutions(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    const actions::Catalogue& catalogue_;
    std::vector<std::string> arms_; ///< that ship with the program, looked up once, and what was opened
};

} // namespace millwright::panels
