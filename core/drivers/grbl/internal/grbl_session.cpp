#include "core/drivers/grbl/internal/grbl_session.h"

#include "core/base/error.h"
#include "core/links/link.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

constexpr char reset_byte = '\x18';
constexpr double repeat_time = 0.25;  // s after which a byte that had no effect is sent again
constexpr double braking_time = 10.0; // s: longer than any machine brakes
constexpr double flushing_time = 3.0; // s in which a reset is answered
constexpr double answer_time = 5.0;   // s without an answer, at rest, after which one was lost
constexpr double homing_time = 600.0; // s of silence that a homing cycle may keep
constexpr int greatest_line_number = 9'999'999;

} // namespace

bool GrblSession::active() const {
    return stage_ == Stage::running || stage_ == Stage::asking_again || stage_ == Stage::jogging ||
           stage_ == Stage::homing || stage_ == Stage::foreign;
}

/// What was doubted before a link broke still is.
void GrblSession::opened(double now) {
    PositionDoubt doubt = std::move(doubt_);
    const bool length_left = tool_length_.left;
    const bool zero_of_other = tool_length_.zero_of_other;
    *this = GrblSession(settings_);
    doubt_ = std::move(doubt);
    tool_length_.left = length_left;
    tool_length_.zero_of_other = zero_of_other;
    stage_ = Stage::greeting;
    last_heard_ = ending_since_ = now;
    host_stall_.begin(now);
    next_poll_ = now;
}

void GrblSession::closed() {
    stage_ = Stage::closed;
    output_.clear();
}

/// A controller without its host goes on with what it has.
std::string GrblSession::what_it_may_execute(bool in_program) const {
    if (!in_program) {
        return "; the controller may still execute what it has received";
    }
    const int open = next_line_ - tracker_.executed_lines();
    return open == 0 ? std::string()
                     : fmt::format("; the controller may still execute up to {} line{} that it has received",
                                   open,
                                   open == 1 ? "" : "s");
}

void GrblSession::lost(const std::string& why) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    const bool moving = (active() || stage_ == Stage::braking) && !checks();
    const bool in_program =
        at_ == Activity::program && (stage_ == Stage::running || stage_ == Stage::braking);
    link_lost_ = true;
    stage_ = Stage::alarm;
    message_ = links::loss_sentence(why);
    if (moving) {
        message_ += what_it_may_execute(in_program);
    }
    output_.clear();
    answer_.break_off(message_);
    drop_change();
}

void GrblSession::receive(std::string_view bytes, double now) {
    constexpr std::size_t longest_line = 1024;
    for (const char byte : bytes) {
        if (byte == '\n') {
            std::string line = std::exchange(input_, {});
            if (line.ends_with('\r')) {
                line.pop_back();
            }
            handle_line(line, now);
        } else if (input_.size() < longest_line) {
            input_ += byte;
        }
    }
    pump();
    pump_jog();
    drop_change();
}

void GrblSession::tick(double now) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    const double pause = host_stall_.taken(now);
    last_heard_ = std::min(now, last_heard_ + pause);
    last_answer_ = std::min(now, last_answer_ + pause);
    if (stage_ == Stage::greeting || stage_ == Stage::asking) {
        ending_since_ = std::min(now, ending_since_ + pause);
    }
    watch_silence(now);
    watch_ending(now);
    watch_hold(now);
    watch_jog(now);
    watch_answers(now);
    step_overrides(now);
    poll(now);
    drop_change();
    watch_change(now);
    pump();
    pump_jog();
}

void GrblSession::step_overrides(double now) {
    if (stage_ == Stage::ready || stage_ == Stage::stopped || active()) {
        output_ += overrides_.take_step(now);
    }
}

void GrblSession::poll(double now) {
    if (now < next_poll_ || stage_ == Stage::flushing) {
        return;
    }
    output_ += status_byte();
    constexpr double quick = 0.25; // a jog and overrides go by what the reports tell
    const bool hurry =
        stage_ == Stage::braking || stage_ == Stage::jogging || (active() && overrides_.under_way());
    next_poll_ = now + (hurry ? quick * settings_.poll_interval : settings_.poll_interval);
}

void GrblSession::watch_silence(double now) {
    if (stage_ == Stage::greeting || stage_ == Stage::asking) {
        if (stage_ == Stage::asking && resets_due_ > 0 && now - last_reset_ > 4.0 * repeat_time) {
            send_reset(now);
        }
        const double silence = now - ending_since_;
        if (silence > settings_.greeting_time) {
            stage_ = Stage::alarm;
            message_ = "no Grbl controller answers at this port";
            message_ += asking_.stray_line.empty() ? "" : fmt::format("; received '{}'", asking_.stray_line);
        } else if (stage_ == Stage::greeting && silence > settings_.greeting_time / 2.0) {
            // After a limit switch Grbl is deaf to all but a reset, and a board that begins anew waits for a
            // boot loader. Both stand still.
            readout_.began_anew = true;
            begin_asking(now, false);
        }
        return;
    }
    const double patience = stage_ == Stage::homing ? homing_time : settings_.patience;
    if (now - last_heard_ <= patience || stage_ == Stage::alarm || stage_ == Stage::flushing) {
        return;
    }
    if (active()) {
        fail("the controller no longer answers", now);
    } else if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        stage_ = Stage::alarm;
        message_ = "the controller no longer answers";
    }
}

void GrblSession::send_reset(double now) {
    output_ += reset_byte;
    ++resets_due_;
    last_reset_ = now;
    window_.clear();
    tracker_.disturbed();
    overrides_.forget();
    sent_alone_ = zero_.moves = false; // the first report after it shows the offset
}

/// Brakes to rest, then empties the controller's buffers by a reset. Nothing else is sent in the meantime.
void GrblSession::end(bool fault, std::string message, double now) {
    if (stage_ == Stage::braking || stage_ == Stage::flushing) {
        if (fault && !ending_.in_fault) {
            ending_.in_fault = true;
            ending_.message = std::move(message);
        }
        return;
    }
    stage_ = Stage::braking;
    ending_.in_fault = fault;
    ending_.message = std::move(message);
    ending_since_ = last_brake_ = now;
    rest_reports_ = 0;
    message_.clear();      // why it paused, or was found moving, is not why it stops
    output_ = hold_byte(); // whatever was to be sent is not sent any more
    next_poll_ = now;
}

void GrblSession::fail(const std::string& message, double now) {
    if (active() || stage_ == Stage::braking) {
        end(true, message, now);
    }
}

void GrblSession::watch_ending(double now) {
    if (stage_ == Stage::braking) {
        constexpr int enough_reports = 2;
        const bool given_up = now - ending_since_ > braking_time || now - last_heard_ > settings_.patience;
        if (rest_reports_ >= enough_reports || given_up) {
            stage_ = Stage::flushing;
            ending_since_ = now;
            send_reset(now);
        } else if (now - last_brake_ > repeat_time) {
            output_ += hold_byte();
            last_brake_ = now;
        }
    } else if (stage_ == Stage::flushing) {
        if (now - ending_since_ > flushing_time) {
            doubt_.arise("the controller did not respond to a reset");
            ending_.in_fault = true;
            ending_.message += ending_.message.empty() ? "" : "; ";
            ending_.message +=
                "the controller does not respond to a reset; check that the machine has stopped";
            finish_ending(now);
        } else if (now - last_reset_ > 2.0 * repeat_time) {
            send_reset(now);
        }
    }
}

void GrblSession::finish_ending(double now) {
    if (!ending_.in_fault && readout_.settings.empty()) { // stopped before it was asked anything
        begin_asking(now, false);
        return;
    }
    message_ = ending_.message;
    hold_.state = HoldState::none;
    jogging_.stopping = single_block_.waits = false;
    window_.clear();
    answer_.break_off(message_);
    if (ending_.in_fault) {
        stage_ = Stage::alarm;
    } else {
        proof_closed_ = true; // what it had acknowledged, the reset has thrown away
        ask_again(Stage::stopped, now);
    }
}

/// What a program, a command or a reset has changed: stored offsets and modes; `first` goes before.
void GrblSession::ask_again(Stage then, double now, const std::string& first) {
    asking_.questions = {"$G", "$#"}; // the last comes first
    if (!first.empty()) {
        asking_.questions.push_back(first);
    }
    asking_.then = then;
    stage_ = Stage::asking_again;
    window_ = Window(readout_.buffer_bytes, true);
    last_answer_ = last_heard_ = now;
    idle_unanswered_ = 0;
    ask_next();
}

void GrblSession::watch_hold(double now) {
    if ((stage_ == Stage::running || stage_ == Stage::foreign) && hold_.state == HoldState::wanted &&
        now - hold_.sent > repeat_time) {
        output_ += hold_byte();
        hold_.sent = now;
    }
}

/// A line that is not answered although the machine stands still and dwells no longer has lost its answer.
void GrblSession::watch_answers(double now) {
    const bool expects_answers =
        stage_ == Stage::running || stage_ == Stage::asking_again || stage_ == Stage::jogging;
    constexpr int reports_to_greet = 20; // two seconds
    if (leaves_check_mode() && idle_unanswered_ >= reports_to_greet) {
        fail("the controller does not leave check mode", now);
        return;
    }
    const bool waits_for_more = report_ && report_->state != MachineState::idle && !checks();
    if (!expects_answers || window_.empty() || hold_.state != HoldState::none || !report_ || waits_for_more) {
        last_answer_ = now;
        idle_unanswered_ = 0;
        return;
    }
    double dwells = 0.0;
    for (const SentLine& line : window_.lines()) {
        dwells += line.dwell;
    }
    constexpr int enough_reports = 10; // a controller that is itself kept from its work has said less
    if (now - last_answer_ > answer_time + dwells && idle_unanswered_ >= enough_reports) {
        fail("an acknowledgement was lost, so answers can no longer be matched to lines", now);
    }
}

/// Some lines go alone. While Grbl writes its EEPROM it loses what it is sent, so that such a line has the
/// receive buffer for itself. And work positions count from a new offset at once, while the offset itself is
/// reported later: where Grbl reports work positions, it changes at rest, and nothing moves before it is
/// known.
bool GrblSession::may_send(const ProgramLine& line) const {
    if ((sent_alone_ && !window_.empty()) || zero_.moves) {
        return false;
    }
    const bool needs_rest = line.moves_zero && zero_.reports_work && at_ != Activity::check;
    return !(line.goes_alone() || needs_rest) || (window_.empty() && (!needs_rest || tracker_.settled()));
}

/// Sends as much of the program as the controller has room for.
void GrblSession::pump() {
    if (stage_ != Stage::running || hold_.state != HoldState::none || stops_here()) {
        return;
    }
    while (next_line_ < std::ssize(program_.lines) && !single_block_.waits) {
        const ProgramLine& line = program_.lines[static_cast<std::size_t>(next_line_)];
        std::string text = line.text + "\n";
        if (readout_.line_numbers && line.block < greatest_line_number && !line.is_setting()) {
            text.insert(0, fmt::format("N{}", line.block + 1));
        }
        if (!window_.has_room_for(text.size()) || !send_window_.allows(line.block) || !may_send(line)) {
            return;
        }
        zero_.moves = line.moves_zero && zero_.reports_work && at_ != Activity::check;
        sent_alone_ = line.goes_alone() || zero_.moves;
        output_ += text;
        window_.push({LineKind::program, std::move(text), next_line_, line.dwell});
        ++next_line_;
        single_block_.waits = single_block_.on && at_ == Activity::program && !change_;
        if (stops_here()) {
            return;
        }
    }
}

} // namespace millwright::drivers::grbl
