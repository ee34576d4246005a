#include "ui/machine_panels/start_line_fields.h"

#include "core/base/text.h"
#include "ui/machine_panels/manual_position_fields.h"
#include "ui/panels/lines.h"
#include "ui/widgets/arithmetic.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace millwright::panels {

namespace {

using actions::StartAt;

void set_begin(ActionQueue& ask, StartAt begin) {
    ask.show([begin = std::move(begin)](actions::ViewState& view_state) { view_state.start_at = begin; });
}

int line_count(const FrameState& now) {
    if (now.in_file()) {
        return now.opened->text ? static_cast<int>(now.opened->text->lines().count()) : 1;
    }
    const auto listing = now.listing();
    return listing ? listing->line_count() : 1;
}

std::optional<double> height(std::string_view text) {
    const widgets::Evaluated read = widgets::evaluate(text);
    return read.value && std::isfinite(*read.value) ? read.value : std::nullopt;
}

void draw_numbers(Ui& ui, const FrameState& now, ActionQueue& ask) {
    StartAt begin = now.view_state.start_at;
    const int last = std::max(line_count(now), 1);
    const std::string of_all = fmt::format("of {}", last);
    const widgets::FieldInfo info{"line",
                                  "Start line",
                                  of_all,
                                  "First program line to execute",
                                  1.0,
                                  static_cast<double>(last),
                                  std::numeric_limits<double>::quiet_NaN(),
                                  0};
    if (const auto line = ui.integer(begin.line, info)) {
        begin.line = *line;
        set_begin(ask, begin);
    }
    const auto check = [](std::string_view text) {
        return text.empty() || height(text) ? std::string() : std::string("Enter a height, or leave empty");
    };
    if (const auto text = ui.expression("clearance",
                                        "Clearance Z",
                                        begin.clearance ? shortest(*begin.clearance) : std::string(),
                                        check,
                                        "Z height in work coordinates, mm, at and above which the tool can "
                                        "move freely. Empty: the highest rapid above the line")) {
        begin.clearance = text->empty() ? std::nullopt : height(*text);
        set_begin(ask, begin);
    }
    const auto here = current_line(now);
    if (here >= 0 &&
        ui.button("cursor",
                  fmt::format("Use current line ({})", here + 1),
                  {},
                  {{}, widgets::Rank::quiet, -1.0F, "Start at the current line of the listing"})) {
        begin.line = static_cast<int>(here) + 1;
        set_begin(ask, begin);
    }
}

/// Homing or a new zero take it away as well.
void draw_doubt(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const std::string& doubt = now.connection.status.position_doubt;
    if (needs_manual_position(now.connection)) {
        manual_position_fields(ui, now, ask);
        return;
    }
    if (!now.connection.connected() || doubt.empty()) {
        return;
    }
    (void)widgets::banner(
        ui, "doubt", {widgets::Severity::warning, drivers::doubt_sentence(doubt), std::string()});
    if (ui.toggle("trust",
                  "Confirm position",
                  false,
                  "Confirm, after inspecting the machine, that the displayed position is correct")) {
        ask.run("machine.trust_position");
    }
}

void draw_approach(Ui& ui, const FrameState& now) {
    if (!now.approach) {
        ui.note("Computing the approach \u2026");
        return;
    }
    const actions::Approach& approach = *now.approach;
    if (approach.refusal) {
        std::string text = approach.refusal->message;
        if (!text.empty()) {
            text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
        }
        const std::string& hint = approach.refusal->hint;
        const int line = approach.refusal->place.line;
        (void)widgets::banner(ui,
                              "refusal",
                              {widgets::Severity::warning,
                               text + (hint.empty() ? "" : " (" + hint + ")"),
                               line > 0 ? fmt::format("line {}", line) : std::string()});
        return;
    }
    ui.note(fmt::format("Before line {}, the machine sets the modes that the lines above would have set, "
                        "raises the tool, moves above the start point and plunges at the feed rate:",
                        approach.wish.begin.line));
    std::string lines;
    for (const std::string& line : approach.lines) {
        lines += (lines.empty() ? "" : "\n") + line;
    }
    ui.text(lines);
}

} // namespace

void start_line_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto scope = ui.scope("begin");
    const StartAt& begin = now.view_state.start_at;
    const widgets::Permission can =
        now.job.running ? widgets::Permission::refused("A job is running.") : actions::program_ready(now);
    if (const auto on =
            ui.toggle("on",
                      "Run from line",
                      begin.on,
                      "Restart in the middle of the program, for example after a broken tool: the modes set "
                      "by the lines above are restored, and the tool approaches from above",
                      can)) {
        const auto here = std::max<std::ptrdiff_t>(current_line(now), 0);
        set_begin(ask, *on ? StartAt{true, static_cast<int>(here) + 1, std::nullopt, {}} : StartAt{});
    }
    if (begin.on && can.allowed) {
        draw_numbers(ui, now, ask);
        draw_doubt(ui, now, ask);
        draw_approach(ui, now);
    }
}

} // namespace millwright::panels
