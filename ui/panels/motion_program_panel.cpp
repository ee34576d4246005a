#include "ui/panels/motion_program_panel.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/actions/arm_bench.h"
#include "ui/panels/internal/fields.h"
#include "ui/widgets/text_area.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::panels {

namespace {

using widgets::Rank;

constexpr const char* writing = "Write a motion program";

std::string fault_of(const std::vector<Diagnostic>& faults, int line) {
    const auto found = std::ranges::find(faults, line, [](const Diagnostic& one) { return one.place.line; });
    if (found == faults.end()) {
        return {};
    }
    return found->message + (found->hint.empty() ? "" : " (" + found->hint + ")");
}

} // namespace

void MotionProgramPanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    {
        const auto row = ui.row(5);
        action_button(ui, now, ask, catalogue_, "arm.simulate", Rank::primary, "Simulate");
        action_button(ui, now, ask, catalogue_, "arm.send_program", Rank::normal, "Send");
        action_button(ui, now, ask, catalogue_, "arm.run_program", Rank::normal, "Run");
        action_button(ui, now, ask, catalogue_, "arm.open_program", Rank::normal, "Open");
        action_button(ui, now, ask, catalogue_, "arm.save_program", Rank::normal, "Save");
    }
    const auto& faults = now.arm.program().faults();
    if (now.arm.program().busy()) {
        ui.words("Being simulated \u2026", widgets::Tone::muted);
    } else if (!faults.empty()) {
        const Diagnostic& first = faults.front();
        const std::string more = faults.size() > 1 ? fmt::format(" (and {} more)", faults.size() - 1) : "";
        const std::string place = first.place.line > 0 ? fmt::format("Line {}: ", first.place.line) : "";
        ui.words(with_full_stop(place + first.message + more), widgets::Tone::danger);
    } else {
        ui.words("The card's language: LINEAR, ABS, TM500, X10 Y-5 \u2026 in degrees; ; begins a comment.",
                 widgets::Tone::muted);
    }
    widgets::TextAreaView view;
    view.text = now.project.arm.program;
    view.fault = [&](int line) { return fault_of(faults, line); };
    const widgets::TextAreaAnswer answer = widgets::text_area(ui, "text", view);
    if (answer.begins_step) {
        ask.end_step();
    }
    if (answer.text) {
        ask.edit(
            writing,
            [text = *answer.text](project::Project& draft) { draft.arm.program = text; },
            "motion program");
    }
    if (answer.left) {
        ask.end_step();
    }
    // What else was changed in the project is not taken back from within the text, where nobody sees it.
    if (answer.history < 0 && now.undo_title == writing) {
        ask.run("edit.undo");
    } else if (answer.history > 0 && now.redo_title == writing) {
        ask.run("edit.redo");
    }
}

} // namespace millwright::panels
