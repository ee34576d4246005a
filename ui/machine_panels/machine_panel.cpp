#include "ui/machine_panels/machine_panel.h"

#include "core/base/text.h"
#include "ui/machine_panels/job_time_left.h"
#include "ui/machine_panels/start_line_fields.h"
#include "ui/machine_panels/tool_change_fields.h"
#include "ui/panels/axis_positions.h"
#include "ui/panels/fields.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/run_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

namespace millwright::panels {

namespace {

constexpr std::array<double, 6> machine_speeds{1.0, 5.0, 20.0, 100.0, 1000.0, 0.0};
constexpr std::array<widgets::Option, 6> machine_speed_options{{{"x1", "1 x (real time)"},
                                                                {"x5", "5 x"},
                                                                {"x20", "20 x"},
                                                                {"x100", "100 x"},
                                                                {"x1000", "1000 x"},
                                                                {"unlimited", "maximum speed"}}};

int speed_index(double speed) {
    for (std::size_t n = 0; n < machine_speeds.size(); ++n) {
        if (!(machine_speeds[n] < speed) && !(machine_speeds[n] > speed)) {
            return static_cast<int>(n);
        }
    }
    return 0;
}

/// A controller is chosen and not connected.
bool waits_for_a_link(const FrameState& now) {
    return now.connection.link == actions::LinkState::none &&
           now.view_state.manual.choice.driver != machine::virtual_driver;
}

std::string checked_sentence(const FrameState& now, const std::string& name) {
    const bool another =
        now.connection.connected() && now.connection.choice.driver != machine::virtual_driver;
    const auto is_bounded = [](const auto& axis) { return axis.min.has_value() && axis.max.has_value(); };
    const bool both = another && now.run_check != nullptr && now.run_check->faults.empty() &&
                      now.run_check->wish->source.as_text &&
                      std::ranges::all_of(now.run_check->wish->machine.limits.axes, is_bounded);
    return fmt::format("Check passed: axes and travel are within the limits of {}{}. Feed rates above the "
                       "axis limits are reduced.{}",
                       name,
                       both      ? ", the machine of the project, and of the connected machine"
                       : another ? ", the machine of the project"
                                 : "",
                       another && !both ? " The limits of the connected machine are checked before the start."
                                        : "");
}

/// 1/min that the program shown begins with, on a machine that has no words for its spindle.
std::optional<double> spindle_by_hand(const FrameState& now) {
    const bool in_file = now.in_file();
    const auto program = !in_file             ? now.program()
                         : now.opened->motion ? now.opened->motion->program
                                              : nullptr;
    if (!now.connection.connected() || now.connection.row().kind != machine::MachineKind::positioned ||
        !program) {
        return std::nullopt;
    }
    constexpr std::size_t beginning = 1000; // blocks: a spindle turns before the first cut
    const auto blocks = std::span(program->blocks).first(std::min(beginning, program->blocks.size()));
    const auto on = std::ranges::find(blocks, program::BlockKind::spindle_on, &program::Block::kind);
    return on == blocks.end() || !(std::abs(on->spindle_rpm) > 0.0) ? std::nullopt
                                                                    : std::optional(on->spindle_rpm);
}

} // namespace

void MachinePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    connection_.draw(ui, now, ask);
    if (now.arm_connected()) { // it takes no G-code, and has no spindle and no work offsets
        return;
    }
    draw_job(ui, now, ask);
    tool_change_fields(ui, now, ask);
    if (now.connection.connected()) {
        controls_.draw(ui, now, ask);
    }
}

void MachinePanel::draw_left(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.connection.connected()) {
        manual_.draw(ui, now, ask);
        connection_.draw_messages(ui, now, ask);
    } else {
        draw_position(ui, now);
    }
}

void MachinePanel::draw_position(Ui& ui, const FrameState& now) const {
    const auto section =
        ui.section("position", now.follows_job() ? "Machine position" : "Position at timeline");
    if (section) {
        axis_positions(ui, now);
    }
}

/// What is known before anything is sent.
void MachinePanel::draw_findings(Ui& ui, const FrameState& now) const {
    const bool is_said = now.follows_job() || !actions::axes_ready(now).allowed;
    if (const auto checked = actions::run_check_passed(now); !checked.allowed && !is_said) {
        (void)widgets::banner(ui, "findings", {widgets::Severity::warning, checked.reason, {}});
        return;
    }
    if (!now.in_file() || !now.opened->finished || now.follows_job()) {
        return;
    }
    const auto& opened = *now.opened;
    if (opened.start_notice && !(now.connection.connected() && now.connection.status.position_known)) {
        ui.note(fmt::format("Line {}: {}.", opened.start_notice->place.line, opened.start_notice->message));
    }
    const std::size_t found = opened.errors.size() + opened.faults.size() + opened.findings.size();
    if (found == 0) {
        ui.note(opened.motion && opened.machine ? checked_sentence(now, opened.machine->name())
                                                : "Check passed: no syntax errors.");
        return;
    }
    const Diagnostic& first = !opened.errors.empty()   ? opened.errors.front()
                              : !opened.faults.empty() ? opened.faults.front()
                                                       : opened.findings.front();
    const std::string more = found > 1 ? fmt::format(", and {} more", found - 1) : "";
    const std::string where = first.place.line > 0 ? fmt::format("line {}: ", first.place.line) : "";
    (void)widgets::banner(ui, "findings", {widgets::Severity::warning, where + first.message + more, {}});
}

/// How a program is run: how fast, or block by block.
void MachinePanel::draw_mode(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    if (now.connection.link == actions::LinkState::none) {
        if (const auto chosen = ui.choice("speed",
                                          "Virtual machine",
                                          speed_index(now.view_state.machine_speed),
                                          machine_speed_options,
                                          "Simulation speed of the virtual machine")) {
            ask.show([speed = machine_speeds[static_cast<std::size_t>(*chosen)]](
                         actions::ViewState& view_state) { view_state.machine_speed = speed; });
        }
    } else if (now.connection.can.program.single_block) {
        const actions::Action& single = catalogue_.find("machine.single_block");
        if (ui.toggle("single_block",
                      "Single block",
                      now.view_state.manual.single_block,
                      single.info().tip,
                      single.permission(now))) {
            ask.run("machine.single_block");
        }
    }
}

namespace {

/// Why a job holds on a machine that is not connected, and so has no messages of a controller.
void wait_banner(Ui& ui, const FrameState& now) {
    if (!now.job.running || !now.job.report || now.connection.connected()) {
        return;
    }
    const drivers::DriverStatus& status = now.job.report->driver;
    if (status.state == drivers::DriverState::holding && !status.message.empty()) {
        (void)widgets::banner(ui,
                              "waiting",
                              {widgets::Severity::warning,
                               fmt::format("Job waiting: {}. Press Resume to continue.", status.message),
                               {}});
    }
}

} // namespace

/// What acts on a running job.
void MachinePanel::draw_stops(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    {
        const drivers::DriverStatus& status = now.connection.status;
        const bool waits = actions::waits_for_tool(status) && !status.tool_change->held;
        const auto row = ui.row(3);
        action_button(ui, now, ask, catalogue_, "machine.hold", widgets::Rank::normal, "Hold");
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "machine.resume",
                      waits ? widgets::Rank::primary : widgets::Rank::normal,
                      waits ? "Continue" : "Resume");
        action_button(ui, now, ask, catalogue_, "machine.stop", widgets::Rank::normal, "Stop");
    }
    action_button(ui, now, ask, catalogue_, "machine.emergency_stop", widgets::Rank::danger);
    ui.keep_clear(ui.path("machine_emergency_stop"));
}

void MachinePanel::draw_job(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("job", "Job");
    if (!section) {
        return;
    }
    ui.value("program", "Program", now.in_file() ? now.opened->file.filename().string() : now.project.name);
    draw_mode(ui, now, ask);
    start_line_fields(ui, now, ask);
    const actions::StartAt& begin = now.view_state.start_at;
    action_button(ui,
                  now,
                  ask,
                  catalogue_,
                  "machine.run",
                  waits_for_a_link(now) ? widgets::Rank::normal : widgets::Rank::primary,
                  begin.on ? fmt::format("Run from line {}", begin.line) : std::string("Run"));
    if (waits_for_a_link(now)) {
        ui.note("Not connected: Run simulates on the virtual machine.");
    }
    draw_stops(ui, now, ask);
    if (const auto rpm = spindle_by_hand(now)) {
        (void)widgets::banner(ui,
                              "spindle_by_hand",
                              {widgets::Severity::warning,
                               fmt::format("This machine has no spindle control: start the spindle manually "
                                           "at {:.0f} rpm before you run the program.",
                                           *rpm),
                               {}});
    }
    if (const widgets::Permission axes = actions::axes_ready(now); !axes.allowed) {
        (void)widgets::banner(ui, "axes", {widgets::Severity::warning, axes.reason, {}});
    }
    (void)tool_change_banner(ui, now);
    wait_banner(ui, now);
    draw_findings(ui, now); // below the buttons, which stay where they are whatever is found
    draw_progress(ui, now, ask);
}

void MachinePanel::draw_progress(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    if (!now.job.name.empty() && !now.job_is_shown()) { // begun from the queue
        ui.value("of",
                 now.job.running ? "Running" : "Last job",
                 std::filesystem::path(now.job.project).filename().string());
    }
    if (now.job.running && now.job.report) {
        const jobs::JobReport& report = *now.job.report;
        ui.value("state", "State", to_text(report.driver.state));
        const std::optional<double> left = job_time_left(now, report);
        ui.value("elapsed", "Elapsed", clock_time(report.elapsed));
        ui.value("left", "Remaining", left ? clock_time(std::max(0.0, *left)) : "unknown");
        if (report.driver.sent_blocks > report.driver.executed_blocks) {
            ui.value("sent", "Blocks sent", fmt::format("{}", report.driver.sent_blocks));
        }
        int block = report.driver.executed_blocks;
        if (report.answers && report.line > 0 &&
            report.driver.block > block) { // the last that is known is behind
            ui.value("confirmed", "Blocks confirmed", fmt::format("{}", block));
            ui.value("line", "Running", fmt::format("line ~{}", report.line));
            block = report.driver.block;
        }
        if (ui.progress("progress", fmt::format("Block {} of {}", block, report.blocks), report.fraction())) {
            ask.run("machine.stop");
        }
    } else if (now.job.outcome) {
        ui.value("end", "Last job", to_text(now.job.outcome->end));
        ui.note(now.job.outcome->sentence);
        ui.note("Log: " + now.job.outcome->log_file.string());
    }
    if (now.job.failure) {
        const std::string whose = now.job_is_shown() ? std::string() : now.job.name + ": ";
        (void)widgets::banner(
            ui, "failure", {widgets::Severity::danger, whose + to_text(*now.job.failure), {}});
    }
}

} // namespace millwright::panels
