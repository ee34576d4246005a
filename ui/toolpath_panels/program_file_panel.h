// The inspector of an opened G-code file: what it is, whose rules and machine it is read for, what is wrong
// with it, and what is in force at the current line.
#pragma once

#include "ui/panels/panel.h"

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::panels {

class ProgramFilePanel final : public Panel {
public:
    explicit ProgramFilePanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_file(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_choices(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_faults(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_modal(Ui& ui, const FrameState& now) const;

    const actions::Catalogue& catalogue_;
    std::vector<std::string> machines_; ///< ids; looked up once
};

/// Why the motion is not faster at a block, for people: "velocity of X".
[[nodiscard]] std::string limit_text(const motion::Cause& limit, const program::Program& program);

} // namespace millwright::panels
