// What the controller says, and what follows from it.
#include "core/base/numbers.h"
#include "core/drivers/grbl/codes.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

std::string one_line(std::string text) {
    while (!text.empty() && text.back() == '\n') {
        text.pop_back();
    }
    return text;
}

/// What of a line can be shown.
std::string printable(std::string_view line) {
    constexpr std::size_t enough = 40;
    std::string text;
    for (const char c : line.substr(0, enough)) {
        text += c >= ' ' && c <= '~' ? c : '.';
    }
    return text;
}

void append(std::string& sentence, const std::string& more) {
    sentence += sentence.empty() ? "" : "; ";
    sentence += more;
}

} // namespace

void GrblSession::begin_asking(double now, bool unlock) {
    stage_ = Stage::asking;
    asking_.unlock = unlock;
    ending_since_ = now;
    message_.clear();
    asking_.asked_more = false;
    asking_.found_alarm.clear();
    asking_.kept_lock.clear();
    window_ = Window(readout_.buffer_bytes, true);
    send_reset(now);
}

/// After the greeting that our reset brought.
void GrblSession::ask_first() {
    asking_.questions.clear(); // the last comes first
    if (asking_.unlock) {
        asking_.questions.emplace_back("$X");
    }
    for (const char* question : {"$G", "$#", "$$", "$I"}) {
        asking_.questions.emplace_back(question);
    }
    window_.clear();
    ask_next();
}

void GrblSession::ask_next() {
    report_.reset(); // the next one tells how the controller is after all of this
    if (asking_.questions.empty()) {
        tool_length_.left = tool_length_.left && has_tool_length();
        if (stage_ == Stage::asking_again) {
            stage_ = asking_.then;
            overrides_.forget(); // those that were set since its end
        }
        return;
    }
    std::string text = asking_.questions.back() + "\n";
    asking_.questions.pop_back();
    output_ += text;
    window_.push({LineKind::query, std::move(text), -1, 0.0});
}

/// A program or a command is done; what it changed is asked for before that is reported.
void GrblSession::finish(double now) {
    if (change_ && at_ == Activity::program) { // lines of our own: the program's end is far
        ask_again(Stage::ready, now);
        return;
    }
    if (answer_.pending()) {
        answer_.state = CommandAnswer::State::done;
        take_zeros();
    }
    overrides_.forget(); // they outlast no program, and M2 and M30 have brought them back
    const bool sets = std::ranges::any_of(program_.lines, &ProgramLine::is_setting);
    if (at_ == Activity::program && std::exchange(tool_length_.set, false)) {
        tool_length_.left = true; // until its offsets tell otherwise
        own_lines_.emplace_back("G49");
        zero_.moves = zero_.reports_work;
        ask_again(Stage::ready, now, "G49"); // the length of this job's last tool is not the next one's
        return;
    }
    ask_again(Stage::ready, now, at_ == Activity::command && sets ? "$$" : "");
}

/// A refused command is no longer pending when it comes to its end.
void GrblSession::take_zeros() {
    for (const ProgramLine& line : program_.lines) {
        const std::string axes = axes_zeroed_by(line.text, readout_.axes);
        tool_length_.zero_of_other = tool_length_.zero_of_other && axes.find('Z') == std::string::npos;
        doubt_.zeroed(axes, readout_.axes);
    }
}

void GrblSession::finish_asking(const StatusMessage& report) {
    if (!asking_.unlock) {
        doubt_what_was_found(report);
    }
    if (report.state == MachineState::idle) {
        stage_ = Stage::ready;
        return;
    }
    stage_ = Stage::alarm;
    if (report.state != MachineState::alarm) {
        message_ =
            name() + " is neither idle nor locked after its reset: the door is open, or it is in sleep mode";
        return;
    }
    message_ = !asking_.kept_lock.empty() ? fmt::format("{} remains locked, {}", name(), asking_.kept_lock)
               : !asking_.found_alarm.empty()
                   ? fmt::format("{} is locked, {}", name(), asking_.found_alarm)
                   : name() + " is locked: home the machine, or unlock it without moving";
}

/// After the link was made: what happened before is unknown.
void GrblSession::doubt_what_was_found(const StatusMessage& report) {
    if (report.state == MachineState::alarm) {
        doubt_.arise(name() + " was found locked: after an alarm, or since it was switched on");
    } else if (std::ranges::all_of(readout_.machine_position,
                                   [](double axis) { return exactly_equal(axis, 0.0); })) {
        constexpr bool known_loss = false; // where its zero was set since, all is well
        doubt_.arise("not confirmed since " + name() + " was at zero in all axes, as after switching on",
                     known_loss);
    }
}

void GrblSession::handle_line(std::string_view line, double now) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    const Message message = read_message(line);
    const bool meets = stage_ == Stage::greeting || stage_ == Stage::asking;
    if (meets && std::holds_alternative<Garbage>(message) && asking_.stray_line.empty()) {
        asking_.stray_line = printable(line);
    }
    if (!std::holds_alternative<Garbage>(message) && !std::holds_alternative<Blank>(message)) { // not noise
        last_heard_ = now;
    }
    std::visit([&](const auto& heard) { handle(heard, now); }, message);
}

void GrblSession::handle(const Blank&, double) {}

void GrblSession::handle(const Garbage&, double now) {
    tracker_.disturbed();
    if (stage_ == Stage::foreign) {
        return; // the rest of a line that was meant for somebody else
    }
    fail("data from the controller was corrupted or lost", now);
}

void GrblSession::handle(const StartupLine& line, double now) {
    if (!line.executed) {
        handle(Garbage{}, now);
    }
}

void GrblSession::answered(const SentLine& line) {
    if (line.kind == LineKind::program) {
        tracker_.acknowledged();
    } else if (line.kind == LineKind::home && stage_ == Stage::homing) {
        stage_ = Stage::ready;
        doubt_.homed();
    } else if (line.kind == LineKind::query && (stage_ == Stage::asking || stage_ == Stage::asking_again)) {
        ask_next();
    }
}

void GrblSession::refused(const SentLine& line, const std::string& why, double now) {
    if (line.kind == LineKind::program && at_ == Activity::command && stage_ == Stage::running) {
        answer_.state = CommandAnswer::State::refused;
        answer_.text = fmt::format("{}: {}", one_line(line.text), why);
        next_line_ = static_cast<int>(std::ssize(program_.lines)); // what was planned before comes to its end
    } else if (line.kind == LineKind::program && checks()) {
        refused_in_check(line, why, now);
    } else if (line.kind == LineKind::program && change_) {
        fail(fmt::format("a line of the tool change was refused, {}: {}", why, one_line(line.text)), now);
    } else if (line.kind == LineKind::program) {
        const int number = program_.lines[static_cast<std::size_t>(line.index)].line;
        fail(fmt::format("line {} was refused, {}: {}", number, why, one_line(line.text)), now);
    } else if (line.kind == LineKind::query && (stage_ == Stage::asking || stage_ == Stage::asking_again)) {
        asking_.kept_lock = line.text == "$X\n" ? why : asking_.kept_lock;
        ask_next(); // one that does not know the question
    } else {
        jogging_.feed.cancel();
        jogging_.refused = line.kind == LineKind::jog;
        message_ = why;
        stage_ = line.kind == LineKind::home && stage_ == Stage::homing ? Stage::alarm : stage_;
    }
}

void GrblSession::handle(const Ack&, double now) {
    if (stage_ == Stage::greeting || stage_ == Stage::foreign || stage_ == Stage::flushing ||
        resets_due_ > 0) {
        return; // for something before the reset, or before this link
    }
    if (window_.empty()) {
        fail("the controller acknowledged a line that was not sent", now);
        return;
    }
    last_answer_ = now;
    idle_unanswered_ = 0;
    rest_reports_ = stage_ == Stage::jogging ? 0 : rest_reports_;
    const bool homes = stage_ == Stage::homing;
    answered(window_.pop());
    if (homes && stage_ == Stage::ready) {
        at_ = change_ ? at_ : Activity::homing;
        ask_again(Stage::ready, now); // homing runs the start-up lines, which may set other modes and offsets
    }
    if (stage_ == Stage::jogging && jogging_.stopping) {
        cancel_jog(now); // it read that line after the cancel, and may have begun it
    }
}

void GrblSession::handle(const ErrorAnswer& error, double now) {
    if (stage_ == Stage::greeting || stage_ == Stage::foreign || stage_ == Stage::flushing ||
        resets_due_ > 0) {
        return;
    }
    if (window_.empty()) {
        fail("the controller refused a line that was not sent", now);
        return;
    }
    last_answer_ = now;
    idle_unanswered_ = 0;
    tracker_.disturbed();
    const SentLine line = window_.pop();
    if (line.kind == LineKind::jog && jogging_.stopping && error.number == facts().cancelled_jog_error) {
        return;
    }
    refused(line, explain_grbl_error(error.number, readout_.firmware), now);
}

void GrblSession::handle(const AlarmMessage& alarm, double now) {
    tracker_.disturbed();
    std::string why = explain_grbl_alarm(alarm.number, readout_.firmware);
    if (checks() && !window_.empty() && window_.lines().front().index >= 0) {
        const ProgramLine& at = program_.lines[static_cast<std::size_t>(window_.lines().front().index)];
        why = fmt::format("at line {}, {}", at.line, why);
    }
    if (grbl_alarm_loses_position(alarm.number, readout_.firmware)) {
        doubt_.arise(fmt::format("after alarm {}", alarm.number));
    }
    if (stage_ == Stage::asking && resets_due_ == 0) {
        if (grbl_alarm_needs_reset(alarm.number)) {
            begin_asking(now, false); // it hears nothing else from here on
        } else {
            asking_.found_alarm = why;
        }
        return;
    }
    if (stage_ == Stage::asking_again && resets_due_ == 0 && !grbl_alarm_needs_reset(alarm.number)) {
        asking_.questions.clear(); // the reset of a stop has brought it up: another would bring it again
        window_.clear();
        stage_ = Stage::alarm;
        message_ = why;
        return;
    }
    if (stage_ == Stage::flushing || stage_ == Stage::asking || resets_due_ > 0) {
        append(ending_.message, why);
        ending_.in_fault = true;
        return; // the greeting of the reset follows
    }
    if (stage_ == Stage::greeting) {
        return;
    }
    if (stage_ == Stage::alarm && !grbl_alarm_loses_position(alarm.number, readout_.firmware)) {
        append(message_, why); // of a reset that has another reason
        return;
    }
    const bool was_active = active() || stage_ == Stage::braking;
    if (stage_ != Stage::braking) {
        ending_.message.clear();
    }
    append(ending_.message, why);
    ending_.in_fault = true;
    window_.clear();
    if (was_active) { // it stands still; the reset empties what is left in its buffers
        stage_ = Stage::flushing;
        ending_since_ = now;
        output_.clear();
        send_reset(now);
    } else {
        finish_ending(now);
    }
}

void GrblSession::handle(const Welcome& welcome, double now) {
    if (stage_ == Stage::greeting || stage_ == Stage::asking || stage_ == Stage::foreign) {
        identify(welcome.who); // it is asked for the rest of it next
    }
    tracker_.disturbed();
    input_.clear();
    if (leaves_check_mode()) {
        report_.reset();
        finish_check(now);
        return;
    }
    const bool expected = resets_due_ > 0 || spare_welcomes_ > 0;
    spare_welcomes_ = resets_due_ > 0 ? resets_due_ - 1 : std::max(0, spare_welcomes_ - 1);
    resets_due_ = 0;
    report_.reset();
    switch (stage_) {
    case Stage::greeting:
        readout_.began_anew = true;
        doubt_.arise(name() +
                     " restarted when the connection was made, and counts from where the machine was then");
        begin_asking(now, false);
        break;
    case Stage::asking:
        ask_first();
        break;
    case Stage::foreign:
        doubt_.arise("the controller was reset while the machine was moving");
        begin_asking(now, false);
        break;
    case Stage::flushing:
        finish_ending(now);
        break;
    case Stage::asking_again:
        if (expected) {
            break; // of a reset that was sent twice
        }
        [[fallthrough]];
    case Stage::running:
    case Stage::jogging:
    case Stage::homing:
    case Stage::braking: // lines that were under way may have set it in motion again
        proof_closed_ = true;
        window_.clear();
        doubt_.arise("the controller was reset");
        end(true, "the controller was reset", now);
        break;
    case Stage::ready:
    case Stage::stopped:
        if (!expected) {
            doubt_.arise("the controller was reset");
            stage_ = Stage::alarm;
            message_ = "the controller was reset";
        }
        break;
    case Stage::closed:
    case Stage::alarm:
        break;
    }
}

/// A controller that repeats what it reads lets changed bytes be noticed; others do not.
void GrblSession::check_echo(std::string_view text, double now) {
    if (stage_ != Stage::running) {
        return;
    }
    if (window_.empty() || one_line(window_.lines().front().text) != text) {
        fail(fmt::format("the controller read '{}', which differs from what was sent", text), now);
    }
}

void GrblSession::handle(const Feedback& feedback, double now) {
    if (feedback.tag == "echo") {
        check_echo(feedback.text, now);
        return;
    }
    take_feedback(feedback);
    constexpr std::size_t longest = 2000;
    if (stage_ == Stage::running && at_ == Activity::command && answer_.text.size() < longest) {
        append(answer_.text, fmt::format("[{}:{}]", feedback.tag, feedback.text));
    }
}

} // namespace millwright::drivers::grbl
