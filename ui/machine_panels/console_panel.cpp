#include "ui/machine_panels/console_panel.h"

#include "core/base/text.h"
#include "core/base/text_search.h"
#include "ui/machine_panels/command_line_label.h"
#include "ui/machine_panels/manual_fields.h"
#include "ui/widgets/listing.h"
#include "ui/widgets/notices.h"

#include <algorithm>

namespace millwright::panels {

namespace {

using drivers::ConsoleKind;
using drivers::ConsoleLine;
using widgets::Permission;

constexpr std::size_t most_kept = 20'000;
constexpr std::size_t most_commands = 100;
constexpr std::string_view command_tip =
    "Command line for the machine. Enter: send; arrow keys: history; Tab: complete";

bool is_report(const ConsoleLine& line) {
    return line.kind == ConsoleKind::query || line.kind == ConsoleKind::report;
}

widgets::Colour console_line_colour(const widgets::Palette& colours, const ConsoleLine& line) {
    switch (line.kind) {
    case ConsoleKind::fault:
        return colours.danger;
    case ConsoleKind::message:
        return colours.warning;
    case ConsoleKind::line:
    case ConsoleKind::realtime:
        return colours.accent;
    case ConsoleKind::query:
    case ConsoleKind::report:
    case ConsoleKind::answer:
        break;
    }
    return 0;
}

/// s since `start`; what was sent behind >, what came behind <.
std::string text_of(const ConsoleLine& line, double start) {
    return fixed(line.time - start, 2) + (line.sent ? "  > " : "  < ") + line.text;
}

Permission can_type(const FrameState& now) {
    if (!now.connection.connected()) {
        return Permission::refused("No machine is connected.");
    }
    if (!now.connection.can.manual.command) {
        return Permission::refused("This machine does not accept single commands.");
    }
    return {};
}

Permission can_send(const FrameState& now) {
    if (now.connection.row().kind == machine::MachineKind::arm && !now.connection.status.link_lost) {
        return {}; // it is asked and stopped by lines while it moves, and says itself what has to wait
    }
    const bool busy = now.job.running && !actions::waits_for_tool(now.connection.status);
    return busy ? Permission::refused("A job is running.") : at_rest(now.connection);
}

} // namespace

std::string_view command_line_label(const FrameState& now) {
    return now.arm_connected() ? "Line" : "MDI";
}

void ConsolePanel::follow(const FrameState& now) {
    const auto console = now.console;
    if (console != source_.lock()) {
        source_ = console;
        lines_.clear();
        next_ = 0;
        start_known_ = false;
    }
    if (!console) {
        return;
    }
    console->keep_reports(now.view_state.manual.console.show_reports);
    next_ = console->read(next_, lines_);
    if (!start_known_ && !lines_.empty()) {
        start_ = lines_.front().time;
        start_known_ = true;
    }
    if (lines_.size() > most_kept) {
        lines_.erase(lines_.begin(), lines_.end() - static_cast<std::ptrdiff_t>(most_kept / 2));
    }
    shown_.clear();
    for (std::size_t n = 0; n < lines_.size(); ++n) {
        const bool found = wanted_.empty() || TextPattern(wanted_).next(lines_[n].text, 0);
        if (found && (now.view_state.manual.console.show_reports || !is_report(lines_[n]))) {
            shown_.push_back(n);
        }
    }
}

void ConsolePanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    follow(now);
    draw_command(ui, now, ask);
    if (!now.console) {
        ui.note("Connect a machine to see the commands sent and its responses.");
        return;
    }
    widgets::ListingView view;
    view.lines = std::ssize(shown_);
    view.line = [this](std::ptrdiff_t row) {
        return text_of(lines_[shown_[static_cast<std::size_t>(row)]], start_);
    };
    view.mark = [&](std::ptrdiff_t row) {
        return console_line_colour(ui.colours(), lines_[shown_[static_cast<std::size_t>(row)]]);
    };
    view.numbers = false;
    view.coloured = false;
    view.found = wanted_;
    view.wanted = view.lines - 1;
    (void)widgets::listing(ui, "console", view);
}

void ConsolePanel::draw_command(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const float whole = ui.rest().w;
    const drivers::CommandAnswer& answer = now.connection.status.answer;
    const bool refused = answer.state == drivers::CommandAnswer::State::refused;
    {
        const auto width = ui.width(0.5F * whole);
        const auto labels = ui.label_share(0.16F);
        const auto permitted = ui.permitted(can_type(now));
        if (const auto line =
                ui.command_line("command",
                                command_line_label(now),
                                now.view_state.manual.console.commands,
                                refused ? std::string_view() : command_tip, // which would lie over the reason
                                can_send(now),
                                now.connection.can.words)) {
            ask.tell([line = *line](drivers::Driver& driver) { (void)driver.command(line); });
            ask.show([line = *line](actions::ViewState& view_state) {
                auto& commands = view_state.manual.console.commands;
                std::erase(commands, line);
                commands.push_back(line);
                if (commands.size() > most_commands) {
                    commands.erase(commands.begin());
                }
            });
        }
    }
    ui.beside();
    {
        const float own = 0.25F * whole;
        const auto width = ui.width(own);
        const auto labels = ui.label_share((ui.words_width("Search") + ui.px(widgets::gaps::small)) / own);
        if (const auto text =
                ui.text_field("filter", "Search", wanted_, "Show only lines that contain this text")) {
            wanted_ = *text;
        }
    }
    ui.beside();
    if (const auto on = ui.checkbox("reports",
                                    "Status reports",
                                    now.view_state.manual.console.show_reports,
                                    "Show the status reports (ten per second)")) {
        ask.show([on = *on](actions::ViewState& view_state) { view_state.manual.console.show_reports = on; });
    }
    if (refused) {
        (void)widgets::banner(
            ui, "refused", {widgets::Severity::danger, "Refused: " + answer.text, {}}); // of any length
    } else if (answer.state == drivers::CommandAnswer::State::pending) {
        ui.words("Executing \u2026", widgets::Tone::muted);
    }
}

} // namespace millwright::panels
