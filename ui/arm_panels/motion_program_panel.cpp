#include "ui/arm_panels/motion_program_panel.h"

#include "ui/panels/fields.h"
#include "ui/workspaces/arm_workspace.h"

namespace millwright::panels {

using widgets::Rank;

MotionProgramPanel::MotionProgramPanel(const actions::Catalogue& catalogue)
    : catalogue_(catalogue), editor_(edited_text<&project::Project::arm, &project::ArmInput::program>(
                                 "Edit the motion program", "motion program")) {}

void MotionProgramPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    {
        const auto row = ui.row(6);
        action_button(ui, now, ask, catalogue_, "arm.simulate", Rank::primary, "Simulate");
        action_button(ui, now, ask, catalogue_, "arm.send_program", Rank::normal, "Send");
        action_button(ui, now, ask, catalogue_, "arm.run_program", Rank::normal, "Run");
        action_button(ui, now, ask, catalogue_, "arm.open_program", Rank::normal, "Open");
        action_button(ui, now, ask, catalogue_, "arm.save_program", Rank::normal, "Save");
        editor_.draw_find_button(ui);
    }
    const auto& faults = now.arm.program().faults();
    if (now.arm.program().busy()) {
        ui.words("Simulating \u2026", widgets::Tone::muted);
    } else {
        fault_line(
            ui, faults, "Card commands: LINEAR, ABS, TM500, X10 Y-5 \u2026 in degrees; ; starts a comment.");
    }
    editor_.draw(ui, now, ask, faults);
}

} // namespace millwright::panels
