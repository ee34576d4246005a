#include "ui/plot_panels/table_pane.h"

#include "core/base/text.h"
#include "ui/panels/fields.h"
#include "ui/panels/serial_fields.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/sketch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::panels {

namespace {

using actions::TableChoice;
using drivers::Jitter;
using drivers::PlayState;
using plot::DecodeMode;
using plot::DecodeSettings;
using plot::SampleRounding;
using widgets::FieldInfo;
using widgets::Rect;

// In the order of their enumerators.
constexpr std::array<widgets::Option, 2> modes{
    {{"segments", "Per segment", {}, "Whole number of steps on each segment, as in the thesis"},
     {"path", "Per path", {}, "The remainder of a step is carried over corners"}}};
constexpr std::array<widgets::Option, 4> roundings{{{"down", "Round down", {}, {}},
                                                    {"nearest", "Round to nearest", {}, {}},
                                                    {"up", "Round up", {}, {}},
                                                    {"exact", "Exact, shorter last step", {}, {}}}};

void change_table_choice(ActionQueue& ask, std::function<void(TableChoice&)> what) {
    ask.plot([what = std::move(what)](actions::PlotWorkspace& workspace) {
        TableChoice choice = workspace.table_choice();
        what(choice);
        workspace.set_table(choice);
    });
}

std::string_view play_state_text(PlayState state) {
    switch (state) {
    case PlayState::ready:
        return "ready";
    case PlayState::playing:
        return "moving";
    case PlayState::holding:
        return "held";
    case PlayState::done:
        return "all points sent";
    case PlayState::stopped:
        return "stopped";
    case PlayState::emergency_stop:
        return "emergency stop";
    }
    return {};
}

std::string bound_text(std::size_t n) {
    const bool last = n == Jitter::bounds.size();
    const double us = 1e6 * Jitter::bounds[last ? n - 1 : n];
    const std::string limit = us < 1000.0 ? fmt::format("{:.0f} us", us) : fmt::format("{:.3g} ms", us / 1e3);
    return last ? "later" : limit;
}

/// A bar for each bound, as long as its share.
void histogram(Ui& ui, const Jitter& jitter, const Rect& box) {
    ui.record("histogram", box);
    widgets::Sketch sketch(ui, box);
    const float row = box.h / static_cast<float>(jitter.histogram.size());
    const float words = ui.px(64.0F);
    const float figures = ui.px(80.0F);
    for (std::size_t n = 0; n < jitter.histogram.size(); ++n) {
        const float y = box.y + row * static_cast<float>(n);
        const double part = jitter.count > 0
                                ? static_cast<double>(jitter.histogram[n]) / static_cast<double>(jitter.count)
                                : 0.0;
        const float length = static_cast<float>(part) * std::max(box.w - words - figures, 0.0F);
        sketch.text({box.x, y, words - ui.px(8.0F), row},
                    bound_text(n),
                    ui.colours().muted,
                    widgets::TextAlign::right,
                    widgets::TextFont::small);
        sketch.box(
            {box.x + words, y + 0.15F * row, length, 0.7F * row}, ui.colours().accent, ui.colours().accent);
        sketch.text({box.x + words + length + ui.px(8.0F), y, figures, row},
                    fmt::format("{}", jitter.histogram[n]),
                    ui.colours().text,
                    widgets::TextAlign::left,
                    widgets::TextFont::small);
    }
}

std::string delay_text(double seconds) {
    constexpr double ms = 1e-3;
    return seconds < ms ? fmt::format("{:.0f} us", seconds / (1e-3 * ms))
                        : fmt::format("{:.1f} ms", seconds / ms);
}

/// What is known, a line each: name and text.
std::vector<std::array<std::string, 2>> read_out(const actions::TableView& table) {
    const drivers::PlayStatus& now = table.status;
    return {{"X", fixed(now.position.x(), 3) + " mm"},
            {"Y", fixed(now.position.y(), 3) + " mm"},
            {"Z", fixed(now.position.z(), 3) + " mm"},
            {"Table", std::string(play_state_text(now.state))},
            {"Points", fmt::format("{} of {}", now.points, table.total)},
            {"Mean delay", delay_text(now.jitter.mean)},
            {"99 % delay", delay_text(now.jitter.p99)},
            {"Max. delay", delay_text(now.jitter.most)}};
}

void draw_read_out(Ui& ui, const actions::TableView& table, const Rect& box) {
    const auto lines = read_out(table);
    const float row = box.h / static_cast<float>(lines.size());
    const float name = 0.4F * box.w;
    widgets::Sketch sketch(ui, box);
    for (std::size_t n = 0; n < lines.size(); ++n) {
        const float y = box.y + row * static_cast<float>(n);
        ui.record("read_out/" + std::string(1, "XYZTPmpl"[n]), {box.x, y, box.w, row});
        sketch.text({box.x, y, name, row}, lines[n][0], ui.colours().muted);
        sketch.text({box.x + name, y, box.w - name, row},
                    lines[n][1],
                    ui.colours().text,
                    widgets::TextAlign::left,
                    n < 3 ? widgets::TextFont::mono : widgets::TextFont::normal);
    }
}

/// 0 for none.
void maybe(Ui& ui,
           ActionQueue& ask,
           const FieldInfo& info,
           const std::optional<double>& value,
           std::optional<double> DecodeSettings::*member) {
    if (const auto chosen = ui.number(value.value_or(0.0), info)) {
        change_table_choice(ask, [v = *chosen, member](TableChoice& c) {
            c.decoding.*member = v > 0.0 ? std::optional(v) : std::nullopt;
        });
    }
}

/// How the points come on the path.
void point_fields(Ui& ui, const DecodeSettings& points, ActionQueue& ask) {
    const auto section = ui.section("points", "Steps and limits", false);
    if (!section) {
        return;
    }
    if (const auto mode = ui.choice("mode", "Equal steps", static_cast<int>(points.mode), modes)) {
        change_table_choice(
            ask, [mode = *mode](TableChoice& c) { c.decoding.mode = static_cast<DecodeMode>(mode); });
    }
    maybe(ui,
          ask,
          {"travel_velocity", "Travel speed", "mm/s", "0: same as along the path", 0.0, 1000.0, 0.0, 2},
          points.travel_velocity,
          &DecodeSettings::travel_velocity);
    maybe(ui,
          ask,
          {"plunge_velocity", "Plunge speed", "mm/s", "0: same as along the path", 0.0, 1000.0, 0.0, 2},
          points.plunge_velocity,
          &DecodeSettings::plunge_velocity);
    if (points.mode == DecodeMode::segments) {
        if (const auto rounding =
                ui.choice("rounding", "Step count", static_cast<int>(points.rounding), roundings)) {
            change_table_choice(ask, [rounding = *rounding](TableChoice& c) {
                c.decoding.rounding = static_cast<SampleRounding>(rounding);
            });
        }
        return;
    }
    maybe(ui,
          ask,
          {"acceleration", "Acceleration", "mm/s2", "Maximum acceleration; 0: no limit", 0.0, 1e6, 0.0, 1},
          points.acceleration,
          &DecodeSettings::acceleration);
    maybe(ui,
          ask,
          {"jerk",
           "Jerk",
           "mm/s3",
           "Maximum jerk, used with an acceleration limit; 0: no limit",
           0.0,
           1e9,
           0.0,
           0},
          points.jerk,
          &DecodeSettings::jerk);
}

/// What a point looks like on the wire.
void record_fields(Ui& ui, const drivers::RecordFormat& record, ActionQueue& ask) {
    const auto section = ui.section("record", "Record", false);
    if (!section) {
        return;
    }
    if (const auto pattern =
            ui.text_field("pattern",
                          "Pattern",
                          record.pattern,
                          "Record format, such as t {X} {Y} {Z} {a} {s}: axes, acceleration, speed")) {
        change_table_choice(ask, [pattern = *pattern](TableChoice& c) { c.record.pattern = pattern; });
    }
    if (const auto relative =
            ui.toggle("relative", "Relative", record.relative, "Records contain distances, not positions")) {
        change_table_choice(ask, [relative = *relative](TableChoice& c) { c.record.relative = relative; });
    }
    if (const auto ending = ending_field(ui, record.ending)) {
        change_table_choice(ask, [ending = *ending](TableChoice& c) { c.record.ending = ending; });
    }
    if (const auto answer = ui.text_field("answer",
                                          "Response",
                                          record.answer,
                                          "Response to each record before the next is sent; empty: none")) {
        change_table_choice(ask, [answer = *answer](TableChoice& c) { c.record.answer = answer; });
    }
}

/// What a person has to read: no tip of the buttons above lies over it.
void line_kept_clear(Ui& ui, std::string_view id, std::string_view text, widgets::Tone tone) {
    Rect line = ui.rest();
    line.h = ui.px(26.0F);
    ui.record(id, line);
    ui.keep_clear(ui.path(id));
    ui.words(text, tone);
}

/// The position of the table at the start is not reported.
void start_line_fields(Ui& ui, const TableChoice& choice, const Vec3& at) {
    {
        const auto labels = ui.label_share(0.3F);
        ui.value("begins",
                 "Start",
                 fmt::format("{}  {}  {}", fixed(at.x(), 2), fixed(at.y(), 2), fixed(at.z(), 2)),
                 "mm");
    }
    ui.note(choice.record.relative ? "The table must be at this point: records contain distances only, so "
                                     "any offset shifts the whole cut."
                                   : "The table must be at this point, or it moves there immediately.");
}

} // namespace

std::string table_text(const FrameState& now) {
    const actions::TableView table = now.plot.table().view();
    if (!table.playing) {
        return {};
    }
    const std::string port = now.plot.table().port();
    return fmt::format("{}: {}",
                       port.empty() ? "simulated table" : "table at " + port,
                       table.total == 0 ? "preparing" : play_state_text(table.status.state));
}

/// Nothing where nothing is sent.
std::optional<Vec3> TablePane::place_of_begin(const FrameState& now) {
    const bool begins = !now.plot.table_choice().port.empty() && !now.plot.table().view().playing;
    return begins ? now.plot.table_start() : std::nullopt;
}

void TablePane::draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const TableChoice& choice = now.plot.table_choice();
    if (const auto port = ui.text_field(
            "port",
            "Port",
            choice.port,
            "Serial port such as /dev/ttyUSB0, tcp:HOST:PORT, or file:PATH; empty: nothing is sent")) {
        change_table_choice(ask, [port = *port](TableChoice& c) { c.port = port; });
    }
    if (const auto address = serial_fields(ui, choice.port)) {
        change_table_choice(ask, [address = *address](TableChoice& c) { c.port = address; });
    }
    const DecodeSettings& points = choice.decoding;
    const auto number =
        [&](const FieldInfo& info, double value, double unit, double DecodeSettings::*member) {
            if (const auto chosen = ui.number(value / unit, info)) {
                change_table_choice(ask,
                                    [v = *chosen * unit, member](TableChoice& c) { c.decoding.*member = v; });
            }
        };
    const auto made = now.plot.latest();
    const bool has_points = made && made->points; // at equal steps already
    if (!has_points) {
        number({"velocity", "Velocity", "mm/s", "Constant velocity along the path", 0.01, 1000.0, 8.0, 2},
               points.velocity,
               1.0,
               &DecodeSettings::velocity);
    }
    number({"period", "Period", "ms", "Time between two points", 0.5, 1000.0, 20.0, 1},
           points.period,
           1e-3,
           &DecodeSettings::period);
    if (const auto speed = ui.number(
            choice.speed, {"speed", "Time scale", "x", "Factor of real time", 0.01, 100.0, 1.0, 2})) {
        change_table_choice(ask, [speed = *speed](TableChoice& c) { c.speed = speed; });
    }
    if (const auto begins = place_of_begin(now)) {
        start_line_fields(ui, choice, *begins);
    }
    if (!has_points) {
        point_fields(ui, points, ask);
        action_button(ui, now, ask, catalogue_, "plot.write_points");
    }
    record_fields(ui, choice.record, ask);
}

void TablePane::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    {
        const bool held = now.plot.table().view().status.state == PlayState::holding;
        const auto line = ui.row(3);
        action_button(ui, now, ask, catalogue_, "plot.play_table", widgets::Rank::primary, "Play");
        if (held) {
            action_button(ui, now, ask, catalogue_, "plot.resume_table", widgets::Rank::primary, "Resume");
        } else {
            action_button(ui, now, ask, catalogue_, "plot.hold_table", widgets::Rank::normal, "Hold");
        }
        action_button(ui, now, ask, catalogue_, "plot.stop_table", widgets::Rank::danger, "Stop");
    }
    const actions::TableView table = now.plot.table().view();
    if (table.there && table.status.state == PlayState::emergency_stop) {
        line_kept_clear(ui, "stopped", table.status.sentence, widgets::Tone::danger);
    }
    if (table.status.state == PlayState::holding && !table.status.sentence.empty()) {
        line_kept_clear(
            ui, "waiting", fmt::format("Waiting: {}", table.status.sentence), widgets::Tone::warning);
    }
    if (table.failure) {
        ui.keep_clear(ui.path("table_failure"));
        (void)widgets::banner(ui, "table_failure", {widgets::Severity::warning, to_text(*table.failure), {}});
    }
    const Rect all = ui.rest();
    const float gap = ui.px(24.0F);
    const float part = (all.w - 2.0F * gap) / 3.0F;
    {
        const auto width = ui.width(part);
        draw_choice(ui, now, ask);
    }
    const Rect middle{all.x + part + gap, all.y, part, std::max(all.h, ui.px(150.0F))};
    const Rect right{middle.x + part + gap, middle.y, part, middle.h};
    if (table.there) {
        draw_read_out(ui, table, middle);
        histogram(ui, table.status.jitter, right);
    } else {
        widgets::Sketch sketch(ui, {middle.x, middle.y, 2.0F * part + gap, ui.px(24.0F)});
        sketch.text(sketch.rect(),
                    "Points at constant velocity are sent to the table, one per period.",
                    ui.colours().muted);
    }
    if (table.playing) {
        constexpr double frame = 0.03;
        ui.change_in(frame);
    }
}

} // namespace millwright::panels
