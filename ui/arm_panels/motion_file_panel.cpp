#include "ui/arm_panels/motion_file_panel.h"

#include "ui/panels/fields.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <string>

namespace millwright::panels {

using widgets::Rank;

namespace {

/// The words and flags of the dual-ported RAM, and how far the stream has come.
std::string buffer_text(const pmac::SharedMemoryStream& stream) {
    const pmac::SharedMemoryBuffer& now = stream.buffer();
    return fmt::format("M151 {} M152 {} M153 {}, M154 {}, M155 {}, EQU1 {} of {}",
                       now.words[0],
                       now.words[1],
                       now.words[2],
                       now.runs ? 1 : 0,
                       now.ready ? 1 : 0,
                       now.taken,
                       stream.count());
}

} // namespace

MotionFilePanel::MotionFilePanel(const actions::Catalogue& catalogue)
    : catalogue_(catalogue), editor_(edited_text<&project::Project::arm, &project::ArmInput::motion_file>(
                                 "Edit the motion file", "motion file")) {}

void MotionFilePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    {
        const auto row = ui.row(7);
        action_button(ui, now, ask, catalogue_, "arm.simulate_motion", Rank::primary, "Simulate");
        action_button(ui, now, ask, catalogue_, "arm.stream_motion", Rank::normal, "Stream");
        action_button(ui, now, ask, catalogue_, "arm.play_motion", Rank::normal, "Play");
        action_button(ui, now, ask, catalogue_, "arm.save_result", Rank::normal, "Result");
        action_button(ui, now, ask, catalogue_, "arm.open_motion", Rank::normal, "Open");
        action_button(ui, now, ask, catalogue_, "arm.save_motion", Rank::normal, "Save");
        editor_.draw_find_button(ui);
    }
    const auto& faults = now.arm.motion_file().faults();
    constexpr float step_width = 230.0F;
    {
        const auto width = ui.width(ui.px(step_width));
        const auto labels = ui.label_share(0.5F);
        const widgets::FieldInfo step{"step",
                                      "One result per",
                                      "mm",
                                      "Distance of two points in the result file",
                                      0.001,
                                      1000.0,
                                      5.0,
                                      3};
        if (const auto value = ui.number(now.view_state.manual.arm_result_step, step)) {
            ask.show(
                [to = *value](actions::ViewState& view_state) { view_state.manual.arm_result_step = to; });
        }
    }
    ui.beside();
    const pmac::SharedMemoryStream* const stream = now.arm.stream();
    fault_line(ui,
               faults,
               stream != nullptr && now.arm.moving()
                   ? buffer_text(*stream)
                   : "G1 X300 Z-50 ; relative, in mm; G2, G3 arcs; blocks end with ;");
    editor_.draw(ui, now, ask, faults);
}

} // namespace millwright::panels
