// Tool changes in the middle of a program: the program is laid aside, a person has the machine, and lines of
// our own bring it back to where the program goes on. docs/reference/tool-change.md.
#include "core/base/numbers.h"
#include "core/drivers/grbl/internal/axis_limits.h"
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/grbl_session.h"
#include "core/drivers/grbl/internal/words.h"
#include "core/drivers/mdi_lines.h"
#include "core/gcode/program_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

constexpr std::size_t z_axis = 2;

bool is_tool_change(const Word& word) {
    constexpr double change = 6.0;
    return word.letter == 'M' && std::abs(word.value - change) < 1e-6;
}

/// What of a line with M6 its controller is sent.
std::string without_change(const std::string& line) {
    std::string text;
    std::string_view rest = line;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_not_of("0123456789.+-", 1), rest.size());
        const std::string_view word = rest.substr(0, end);
        const auto read = words_of(word);
        text +=
            read && read->size() == 1 && is_tool_change(read->front()) ? std::string() : std::string(word);
        rest.remove_prefix(end);
    }
    return text;
}

ProgramLines lines_of(const ChangeLines& texts) {
    std::string text;
    for (const std::string& line : texts) {
        text += line + "\n";
    }
    return program_lines(gcode::listing_of(text, "tool change"), {});
}

} // namespace

/// Lines with M6 are sent without it; before those that `changes_` names the program stops.
void GrblSession::take_tool_changes(ProgramLines& program) const {
    for (ProgramLine& line : program.lines) {
        const auto words = words_of(line.text);
        if (!words || std::ranges::none_of(*words, is_tool_change)) {
            continue;
        }
        const auto stop = std::ranges::find(changes_->stops, line.line, &ToolStop::line);
        const bool stops = stop != changes_->stops.end();
        if (!stops && std::ranges::find(changes_->same_tool, line.line) == changes_->same_tool.end()) {
            throw Error(fmt::format("the tool change at line {} is written in an unsupported way", line.line),
                        {},
                        "write it as M6");
        }
        line.stop = stops ? static_cast<int>(stop - changes_->stops.begin()) : -1;
        line.text = without_change(line.text);
        if (line.text.empty()) { // it has to stand for its block: a dwell of no time does nothing
            line.text = stops && stop->tool > 0 ? fmt::format("T{}", stop->tool) : "G4P0";
        }
    }
}

void GrblSession::begin_job(std::optional<ToolChanges> changes, ProgramLines& program) {
    changes_ = std::move(changes);
    offsets_at_start_ = readout_.offsets;
    own_lines_.clear();
    tool_length_.reference_z.reset();
    tool_length_.set = tool_length_.reference_due = false;
    if (!changes_) {
        return;
    }
    if (!changes_->stops.empty() && has_tool_length()) {
        throw Error("a tool length offset of an earlier tool is active", {}, "cancel it with G49");
    }
    if (changes_->needs_zero && tool_length_.zero_of_other) {
        throw Error("tools were changed since the Z zero was set, so it belongs to another tool",
                    {},
                    "set the Z zero with the tool in the spindle");
    }
    take_tool_changes(program);
    tool_length_.reference_due = changes_->reference_first;
}

bool GrblSession::has_tool_length() const {
    const auto length = readout_.offsets.find("TLO");
    return length != readout_.offsets.end() &&
           std::ranges::any_of(length->second, [](double value) { return !exactly_equal(value, 0.0); });
}

const ToolStop& GrblSession::stop_at_hand() const {
    return changes_->stops[static_cast<std::size_t>(change_->stop)];
}

bool GrblSession::waits_for_tool() const {
    return change_ && change_->step == ChangeStep::waiting;
}

/// It takes lines, but begins none of them before somebody resumes.
bool GrblSession::held_at_machine() const {
    return change_ && report_ && report_->held();
}

/// Which zero of Z a person has set since the change began, as "Z of G54 was -50.000 and is -60.000".
std::string GrblSession::zero_set_anew() const {
    constexpr double rounding = 5e-4; // mm, of what $# tells
    for (const auto& [name, before] : change_->offsets) {
        const auto now = readout_.offsets.find(name);
        const bool counts = name != "TLO" && name != "G28" && name != "G30";
        if (counts && now != readout_.offsets.end() &&
            std::abs(now->second[z_axis] - before[z_axis]) > rounding) {
            return fmt::format(
                "Z of {} was {:.3f} and is now {:.3f}", name, before[z_axis], now->second[z_axis]);
        }
    }
    return {};
}

/// Why the tool in the spindle cannot be measured; empty: it can.
std::string GrblSession::why_not_on() const {
    if (changes_->plan.way != ToolChangeWay::probe) {
        return {};
    }
    if (const std::string anew = zero_set_anew(); tool_length_.reference_z && !anew.empty()) {
        return "the Z zero was changed, but with the sensor only the first tool sets it: " + anew +
               "; restore it (G10 L2), or stop";
    }
    if (!tool_length_.reference_z && has_tool_length()) {
        return "a tool length offset is active: cancel it with G49, and set the Z zero";
    }
    return {};
}

/// What a person has to know while it waits, after the sentence of the stop.
std::string GrblSession::what_to_do() const {
    if (change_->held) {
        return "; on hold: resume ends the hold, and the job continues to wait";
    }
    if (changes_->plan.way == ToolChangeWay::probe) {
        return tool_length_.reference_z ? "; do not change the Z zero: the tool is measured"
                                        : "; set the Z zero with this tool, which is the reference";
    }
    return stop_at_hand().highest_z
               ? ""
               : "; no safe height is known yet, so the machine does not move back automatically";
}

/// Whether the next line waits for another tool, or for the first to be measured.
bool GrblSession::stops_here() const {
    const bool in_program = at_ == Activity::program && !change_ && changes_;
    return in_program &&
           (tool_length_.reference_due || (next_line_ < std::ssize(program_.lines) &&
                                           program_.lines[static_cast<std::size_t>(next_line_)].stop >= 0));
}

void GrblSession::watch_change(double now) {
    const bool may_begin = stage_ == Stage::running && window_.empty() && tracker_.settled() &&
                           hold_.state == HoldState::none && !single_block_.waits;
    const bool known = stage_ == Stage::ready && report_.has_value();
    if (may_begin && stops_here()) {
        begin_change(now);
    } else if (waits_for_tool() && known) {
        if (std::exchange(change_->confirmed, false) && report_->state == MachineState::idle) {
            tool_is_changed(now);
        }
    } else if (change_ && stage_ == Stage::ready && !change_->held && report_ &&
               report_->state == MachineState::idle) {
        go_on_changing(now);
    }
}

/// Everything before is executed. What is in force is asked for first.
void GrblSession::begin_change(double now) {
    Change change;
    change.next_line = next_line_;
    change.send_window = send_window_;
    change.stop = tool_length_.reference_due ? -1 : program_.lines[static_cast<std::size_t>(next_line_)].stop;
    change.program = std::move(program_);
    program_ = {};
    tracker_ = ExecutedLineTracker(program_, readout_.planner_blocks, readout_.segment_blocks);
    next_line_ = 0;
    change_ = std::move(change);
    tool_length_.reference_due = false;
    ask_again(Stage::ready, now);
}

/// The program as it was laid aside, everything before its next line executed.
void GrblSession::take_program_back() {
    program_ = std::move(change_->program);
    next_line_ = change_->next_line;
    send_window_ = std::move(change_->send_window);
    at_ = Activity::program;
    tracker_ = ExecutedLineTracker(program_, readout_.planner_blocks, readout_.segment_blocks);
    tracker_.begin_at(next_line_);
    change_.reset();
}

/// Machine coordinates of the zero of the work system that was in force at the change, with these offsets.
Axes GrblSession::work_zero(const std::map<std::string, Axes>& offsets) const {
    Axes zero(readout_.axes.size(), 0.0);
    for (const std::string& name : {change_->modes.work_system, std::string("G92"), std::string("TLO")}) {
        const auto found = offsets.find(name);
        for (std::size_t n = 0; found != offsets.end() && n < std::min(zero.size(), found->second.size());
             ++n) {
            zero[n] += found->second[n];
        }
    }
    return zero;
}

void GrblSession::send_own(const ChangeLines& lines, ChangeStep step, double now) {
    change_->step = step;
    change_->probings = readout_.probings;
    own_lines_.insert(own_lines_.end(), lines.begin(), lines.end());
    send_window_.begin(nullptr, static_cast<int>(std::ssize(lines)));
    begin(lines_of(lines), Activity::program, now);
}

void GrblSession::go_on_changing(double now) {
    switch (change_->step) {
    case ChangeStep::looking:
        change_->modes = mode_words(readout_.modes.text);
        change_->machine = readout_.machine_position;
        change_->zero = work_zero(readout_.offsets);
        change_->offsets = readout_.offsets;
        return send_own(switched_off(), ChangeStep::switching_off, now);
    case ChangeStep::switching_off:
        if (change_->stop < 0) {
            return begin_measuring(now);
        }
        change_->step = ChangeStep::waiting;
        change_->highest_z = readout_.machine_position[z_axis];
        tool_length_.zero_of_other = true; // whatever is put in
        return;
    case ChangeStep::waiting:
        return;
    case ChangeStep::first_touch:
    case ChangeStep::second_touch:
    case ChangeStep::lifting:
        return go_on_measuring(now);
    case ChangeStep::macro:
        tool_length_.set = tool_length_.set || has_tool_length();
        return go_back(now);
    case ChangeStep::setting_length:
        return go_back(now);
    case ChangeStep::going_back:
        return resume_program(now);
    }
}

/// A person has changed the tool and said so.
void GrblSession::tool_is_changed(double now) {
    message_.clear();
    if (const std::string why_not = why_not_on(); !why_not.empty()) {
        message_ = stop_at_hand().why + "; " + why_not;
        return;
    }
    const bool by_sensor = changes_->plan.way == ToolChangeWay::probe;
    tool_length_.zero_of_other = by_sensor ? tool_length_.reference_z.has_value() : zero_set_anew().empty();
    switch (changes_->plan.way) {
    case ToolChangeWay::stop:
        return go_back(now);
    case ToolChangeWay::probe:
        return begin_measuring(now);
    case ToolChangeWay::macro:
        return send_own(macro_lines(), ChangeStep::macro, now);
    }
}

ChangeLines GrblSession::macro_lines() const {
    ChangeLines lines = switched_off();
    lines.push_back("G0G17G21G90G94" + change_->modes.work_system); // as it was checked
    for (const ProgramLine& line :
         program_lines(gcode::listing_of(changes_->plan.macro, changes_->plan.macro_file), {}).lines) {
        lines.push_back(line.text);
    }
    return lines;
}

void GrblSession::begin_measuring(double now) {
    const ToolSensor& sensor = changes_->plan.sensor;
    change_->top = std::max(sensor.travel_z, readout_.machine_position[z_axis]);
    send_own(first_touch(sensor, change_->top), ChangeStep::first_touch, now);
}

void GrblSession::go_on_measuring(double now) {
    const ToolSensor& sensor = changes_->plan.sensor;
    const bool touched = readout_.probe && readout_.probe->touched && readout_.probings > change_->probings;
    if (change_->step != ChangeStep::lifting && !touched) {
        stage_ = Stage::running; // so that it is brought to rest
        fail("the tool sensor gave no result", now);
        return;
    }
    const double z = readout_.probe->position[z_axis];
    constexpr double alike = 0.5; // mm between two touches of one tool
    if (change_->step == ChangeStep::second_touch && std::abs(z - change_->first_touch_z) > alike) {
        stage_ = Stage::running;
        fail(fmt::format("the two touches of the tool sensor differ by {:.3f} mm",
                         std::abs(z - change_->first_touch_z)),
             now);
        return;
    }
    if (change_->step == ChangeStep::first_touch) {
        change_->first_touch_z = z;
        return send_own(second_touch(sensor, z, change_->top), ChangeStep::second_touch, now);
    }
    if (change_->step == ChangeStep::second_touch) {
        return send_own(up_to(change_->top), ChangeStep::lifting, now);
    }
    if (!tool_length_.reference_z) {
        tool_length_.reference_z = z;
        change_->made_reference = true;
        return go_back(now);
    }
    tool_length_.set = true;
    send_own(tool_length(z - *tool_length_.reference_z), ChangeStep::setting_length, now);
}

/// Not lower than the machine is, was before the change, or the program was before it.
WayBack GrblSession::planned_way_back() const {
    const Axes zero = work_zero(readout_.offsets);
    WayBack way{readout_.machine_position, change_->machine};
    for (std::size_t n = 0; n < way.to.size(); ++n) {
        way.to[n] += zero[n] - change_->zero[n];
    }
    const bool of_a_stop = change_->stop >= 0;
    const std::optional<double> highest = of_a_stop ? stop_at_hand().highest_z : std::nullopt;
    way.top = std::max({way.from[z_axis], change_->machine[z_axis], way.to[z_axis]});
    way.top = of_a_stop ? std::max(way.top, change_->highest_z) : way.top;
    if (highest) { // by the zero of the check, and by that of now, whoever has moved it since
        const double moved = zero[z_axis] - change_->zero[z_axis];
        const double moved_since_start = zero[z_axis] - work_zero(offsets_at_start_)[z_axis];
        way.top = std::max({way.top, *highest, *highest + moved, *highest + moved_since_start});
    }
    if (of_a_stop && !highest) { // the program has moved nothing: where it begins, a person decides
        way.moves = changes_->plan.way == ToolChangeWay::probe; // up to its height, which is safe
        way.down = false;
    }
    return way;
}

/// How far the highest Z of the program lies above the travel with the tool in the spindle, mm. Not of a
/// program that goes to the top of the machine itself: it cannot be meant to clear the work by a number.
double GrblSession::lacking_height(double travel_top) const {
    constexpr double at_the_top = 10.0; // mm: a height for parking, as G28 and G53 have it
    constexpr double rounding = 1e-3;
    const std::optional<double> own = change_->stop >= 0 ? stop_at_hand().program_z : std::nullopt;
    if (!own || *own > travel_top - at_the_top) {
        return 0.0;
    }
    const double z = work_zero(readout_.offsets)[z_axis];
    const double moved = std::max(z - change_->zero[z_axis], z - work_zero(offsets_at_start_)[z_axis]);
    const double lacking = *own + moved - travel_top;
    return lacking > rounding ? lacking : 0.0;
}

/// Why the machine cannot go back; empty: it can. Heights above the machine's own are cut to it.
std::string GrblSession::why_no_way_back(WayBack& way) const {
    const MachineLimits limits = machine_limits(readout_);
    for (std::size_t n = 0; n < std::min(limits.axes.size(), way.to.size()); ++n) {
        const MachineLimits::Axis& axis = limits.axes[n];
        if (!axis.min || !axis.max || is_rotary_axis(axis.letter)) {
            continue;
        }
        constexpr double rounding = 1e-3; // mm, of reports
        if (way.to[n] < *axis.min - rounding || way.to[n] > *axis.max + rounding) {
            return fmt::format(
                "the return move would go to {} {:.3f} in machine coordinates, outside {:.3f} ... {:.3f}: {}",
                axis.letter,
                way.to[n],
                *axis.min,
                *axis.max,
                changes_->plan.way == ToolChangeWay::probe && tool_length_.reference_z &&
                        !change_->made_reference
                    ? "use a tool of another length, or stop"
                    : "check the zero of the tool");
        }
        if (n == z_axis) {
            if (const double lacking = lacking_height(*axis.max); lacking > 0.0) {
                return fmt::format(
                    "with this tool the program's height would be {:.3f} mm above the Z travel, and a lower "
                    "return move is not known to be clear: use a shorter tool, or stop",
                    lacking);
            }
            way.top = std::max(std::min(way.top, *axis.max), way.from[z_axis]);
        }
    }
    return {};
}

void GrblSession::go_back(double now) {
    WayBack way = planned_way_back();
    const std::string why_not = way.moves ? why_no_way_back(way) : std::string();
    if (!why_not.empty() && change_->stop >= 0) {
        change_->step = ChangeStep::waiting;
        if (std::exchange(change_->made_reference, false)) {
            tool_length_.reference_z.reset(); // the person may take another tool now
        }
        message_ = stop_at_hand().why + "; " + why_not;
        return;
    }
    if (!why_not.empty()) {
        stage_ = Stage::running; // so that it is brought to rest
        fail(why_not, now);
        return;
    }
    if (!way.moves) {
        own_lines_.emplace_back("(no safe height is known: the machine stays where it is)");
    }
    send_own(
        way_back(way, change_->modes, changes_->plan.spin_up, readout_.axes), ChangeStep::going_back, now);
}

void GrblSession::resume_program(double now) {
    const bool of_a_stop = change_->stop >= 0;
    tool_length_.set = tool_length_.set || has_tool_length(); // whoever has set it
    take_program_back();
    if (of_a_stop) {
        program_.lines[static_cast<std::size_t>(next_line_)].stop = -1;
    }
    proof_closed_ = false;
    window_ = Window(readout_.buffer_bytes, settings_.one_by_one);
    stage_ = Stage::running;
    hold_ = {};
    single_block_.waits = false;
    message_.clear();
    readout_.modes.text.clear();
    readout_.modes.work_system = 0;
    last_answer_ = last_heard_ = now;
    idle_unanswered_ = 0;
    pump();
}

/// A change ends with whatever ends its job; nothing of it is sent later.
void GrblSession::drop_change() {
    const bool goes_on = stage_ == Stage::running || stage_ == Stage::ready || stage_ == Stage::jogging ||
                         stage_ == Stage::homing || stage_ == Stage::braking ||
                         (stage_ == Stage::asking_again && asking_.then == Stage::ready);
    if (change_ && !goes_on) {
        take_program_back();
        proof_closed_ = true;
    }
    if (tool_length_.set && (stage_ == Stage::stopped || stage_ == Stage::alarm)) {
        tool_length_.set = false;
        tool_length_.left = stage_ == Stage::alarm || has_tool_length(); // a stop ends with a reset, and asks
        own_lines_.emplace_back(
            stage_ == Stage::alarm
                ? "(a tool length offset may be active: no job starts until it is cancelled)"
            : tool_length_.left
                ? "(the tool length offset is active: no job starts until G49 has cancelled it)"
                : "(the reset after the stop cancelled the tool length offset)");
    }
}

} // namespace millwright::drivers::grbl
