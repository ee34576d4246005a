#include "ui/window/start_sheet.h"

#include "core/base/counted.h"
#include "core/base/units.h"
#include "core/gcode/axes.h"
#include "ui/panels/fields.h"
#include "ui/render/imgui_compat.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace millwright::panels {

namespace {

using drivers::MachineLimits;
using jobs::ProgramCheck;

constexpr float sheet_width = 560.0F;

bool is_rotary_letter(char letter) {
    return letter >= 'A' && letter <= 'C';
}

std::string axis_value_text(char letter, double value) {
    return fmt::format("{:.3f}", is_rotary_letter(letter) ? to_degrees(value) : value);
}

/// "-300.000 to 0.000", of what is known of it.
std::string travel_text(const MachineLimits::Axis* axis) {
    if (axis != nullptr && axis->min && axis->max) {
        return fmt::format("travel {} to {}",
                           axis_value_text(axis->letter, *axis->min),
                           axis_value_text(axis->letter, *axis->max));
    }
    if (axis != nullptr && axis->travel) {
        return fmt::format("travel {} long", axis_value_text(axis->letter, *axis->travel));
    }
    return "travel unknown";
}

bool stands_still(const ProgramCheck::Range& range, const std::optional<double>& start) {
    constexpr double still = 1e-9; // mm or rad
    const double from = start.value_or(range.min);
    return std::abs(range.min - from) < still && std::abs(range.max - from) < still;
}

void draw_extents(Ui& ui, const actions::StartCheck& check) {
    for (const program::ProgramAxis& axis : check.wish->program_check.axes) {
        const auto index = std::ranges::find(gcode::axis_letters, axis.letter) - gcode::axis_letters.begin();
        const ProgramCheck::Range& range = check.program_check.ranges[static_cast<std::size_t>(index)];
        const std::optional<double>& start = check.program_check.start[static_cast<std::size_t>(index)];
        if (range.empty() || stands_still(range, start)) {
            continue;
        }
        const double least = std::min(range.min, start.value_or(range.min));
        const double most = std::max(range.max, start.value_or(range.max));
        const auto& limits = check.wish->limits.axes;
        const auto limit = std::ranges::find(limits, axis.letter, &MachineLimits::Axis::letter);
        ui.value(std::string(1, axis.letter),
                 fmt::format("{} extents", axis.letter),
                 fmt::format("{} to {} {}; {}",
                             axis_value_text(axis.letter, least),
                             axis_value_text(axis.letter, most),
                             is_rotary_letter(axis.letter) ? "\u00b0" : "mm",
                             travel_text(limit == limits.end() ? nullptr : &*limit)),
                 {},
                 "Extents in machine coordinates from the current position, with the active work offset");
    }
    if (const std::string& modes = check.wish->program_check.modes; !modes.empty()) {
        ui.value("modes",
                 "Start modes",
                 modes,
                 {},
                 "The modes that the controller reports; the check of the extents begins in them");
    }
    if (const std::string unread = jobs::unread_text(check.program_check); !unread.empty()) {
        (void)widgets::banner(ui,
                              "unread",
                              {widgets::Severity::warning,
                               "These extents are without " + unread + ", which could not be read.",
                               {}});
    }
}

void draw_spindle_and_tool(Ui& ui, const ProgramCheck& program_check, const drivers::DriverStatus& status) {
    ui.value("spindle",
             "Spindle",
             program_check.greatest_spindle_rpm > 0.0
                 ? fmt::format("up to {:.0f} rpm", program_check.greatest_spindle_rpm)
                 : std::string("no speed programmed"));
    std::string tools;
    for (const int tool : program_check.tools) {
        tools += fmt::format("{}T{}", tools.empty() ? "" : ", ", tool);
    }
    tools = tools.empty() ? "no tool called" : tools;
    ui.value("tool", "Tool", status.tool > 0 ? fmt::format("{}; T{} in spindle", tools, status.tool) : tools);
}

void draw_check_result(Ui& ui,
                       std::string_view id,
                       widgets::Severity severity,
                       const std::vector<Diagnostic>& found) {
    if (found.empty()) {
        return;
    }
    const Diagnostic& first = found.front();
    const std::string where = first.place.line > 0 ? fmt::format("line {}: ", first.place.line) : "";
    const std::string hint = first.hint.empty() ? "" : " (" + first.hint + ")";
    const std::string more = found.size() > 1 ? fmt::format(", and {} more", found.size() - 1) : "";
    (void)widgets::banner(ui, id, {severity, where + first.message + hint + more, {}});
}

/// What the controller said of the program in its check mode.
void draw_answer(Ui& ui, const drivers::CommandAnswer& answer) {
    using State = drivers::CommandAnswer::State;
    using widgets::Severity;
    if (answer.state == State::pending) {
        ui.note("The controller is checking the program in check mode \u2026");
        return;
    }
    const std::size_t end = answer.text.find('\n');
    const auto more = std::ranges::count(answer.text, '\n');
    const std::string text =
        answer.text.substr(0, end) + (more > 0 ? fmt::format(", and {} more", more) : "");
    (void)widgets::banner(
        ui, "answer", {answer.state == State::done ? Severity::good : Severity::danger, text, {}});
}

std::string axis_values_text(const actions::ConnectionView& machine) {
    std::string text;
    const auto& position = machine.status.position;
    for (Eigen::Index n = 0; n < std::min<Eigen::Index>(position.size(), std::ssize(machine.axes)); ++n) {
        const char letter = machine.axes[static_cast<std::size_t>(n)].letter;
        text +=
            fmt::format("{}{} {}", text.empty() ? "" : "  ", letter, axis_value_text(letter, position[n]));
    }
    return text;
}

/// What would be started, where, and what is known of it.
void draw_wish(Ui& ui, const FrameState& now, const actions::StartWish& wish) {
    const drivers::DriverStatus& status = now.connection.status;
    const auto labels = ui.label_share(0.2F);
    ui.value("program",
             "Program",
             wish.job->from_line > 1
                 ? fmt::format("{}, from line {}", wish.job->name, wish.job->from_line)
                 : fmt::format("{}, {}", wish.job->name, counted(wish.job->block_count(), "block")));
    ui.value("machine", "Machine", wish.machine);
    const bool verified = status.position_known && status.position_doubt.empty();
    ui.value(
        "position",
        "Position",
        fmt::format("{} ({})", axis_values_text(now.connection), verified ? "verified" : "not verified"));
    if (now.start_check && now.start_check->wish == now.view_state.start) {
        draw_extents(ui, *now.start_check);
        draw_spindle_and_tool(ui, now.start_check->program_check, status);
    } else {
        ui.note("Checking the program \u2026");
    }
}

} // namespace

void StartSheet::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto dialog = ui.dialog("start", "Start the job?", ui.px(sheet_width));
    if (!dialog) {
        return;
    }
    const actions::StartWish& wish = *now.view_state.start;
    const drivers::DriverStatus& status = now.connection.status;
    draw_wish(ui, now, wish);
    if (!status.position_doubt.empty()) {
        (void)widgets::banner(
            ui, "doubt", {widgets::Severity::warning, drivers::doubt_sentence(status.position_doubt), {}});
        if (now.connection.can.reports.position) {
            action_button(ui, now, ask, catalogue_, "machine.trust_position");
        }
    }
    if (!wish.gouges.empty()) {
        (void)widgets::banner(ui, "gouges", {widgets::Severity::danger, wish.gouges, {}});
    }
    if (now.start_check && now.start_check->wish == now.view_state.start) {
        if (const std::string& tool = now.start_check->tool; !tool.empty()) {
            (void)widgets::banner(ui, "right_tool", {widgets::Severity::warning, tool, {}});
        }
        draw_check_result(ui, "faults", widgets::Severity::danger, now.start_check->faults);
        draw_check_result(ui, "warnings", widgets::Severity::warning, now.start_check->warnings);
    }
    if (now.view_state.start_answer > 0 && status.answer.number == now.view_state.start_answer) {
        draw_answer(ui, status.answer);
        if (now.start_check && now.start_check->tool_stops > 0) {
            ui.note("The check skips the tool changes (M6), which Millwright performs.");
        }
    }
    ui.gap();
    {
        const auto looks = ui.row(2);
        action_button(ui, now, ask, catalogue_, "start.check");
        action_button(ui, now, ask, catalogue_, "start.trace");
    }
    const auto row = ui.row(2);
    action_button(ui, now, ask, catalogue_, "start.cancel");
    action_button(ui, now, ask, catalogue_, "start.go", widgets::Rank::primary);
    if (ui.escape_pressed()) {
        ask.run("start.cancel");
    } else if (enter_was_up_ && ui.enter_pressed() && catalogue_.find("start.go").permission(now).allowed) {
        ask.run("start.go");
    }
    enter_was_up_ = enter_was_up_ || !render::key_down(render::Key::enter);
}

} // namespace millwright::panels
