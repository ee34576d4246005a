#include "core/machine/drivers/grbl/internal/session.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/machine/drivers/grbl/codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::machine::grbl {

namespace {

constexpr char reset_byte = '\x18';
constexpr char jog_cancel_byte = '\x85';
constexpr double repeat_time = 0.25;  // s after which a byte that had no effect is sent again
constexpr double braking_time = 10.0; // s: longer than any machine brakes
constexpr double flushing_time = 3.0; // s in which a reset is answered
constexpr double answer_time = 5.0;   // s without an answer, at rest, after which one was lost
constexpr double homing_time = 600.0; // s of silence that a homing cycle may keep
constexpr int greatest_line_number = 9'999'999;

} // namespace

bool Session::active() const {
    return stage_ == Stage::running || stage_ == Stage::jogging || stage_ == Stage::homing;
}

std::string Session::take_output() {
    return std::exchange(output_, {});
}

void Session::opened(double now) {
    *this = Session(settings_);
    stage_ = Stage::greeting;
    last_heard_ = ending_since_ = now;
    next_poll_ = now;
}

void Session::closed() {
    stage_ = Stage::closed;
    output_.clear();
}

void Session::lost(const std::string& why) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    const bool moving = active() || stage_ == Stage::braking;
    link_lost_ = true;
    stage_ = Stage::alarm;
    message_ = "the link was lost: " + why;
    if (moving) {
        message_ += fmt::format("; the controller may still execute up to {} lines that it has",
                                readout_.planner_blocks + static_cast<int>(window_.lines().size()));
    }
    output_.clear();
}

void Session::receive(std::string_view bytes, double now) {
    if (!bytes.empty()) {
        last_heard_ = now;
    }
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
}

void Session::tick(double now) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    watch_silence(now);
    watch_ending(now);
    watch_hold(now);
    watch_jog(now);
    watch_answers(now);
    poll(now);
    pump();
}

void Session::poll(double now) {
    if (now < next_poll_ || stage_ == Stage::flushing) {
        return;
    }
    output_ += '?';
    const bool quick = stage_ == Stage::braking || stage_ == Stage::jogging;
    next_poll_ = now + (quick ? 0.5 * settings_.poll_interval : settings_.poll_interval);
}

void Session::watch_silence(double now) {
    if (stage_ == Stage::greeting || stage_ == Stage::asking) {
        if (stage_ == Stage::asking && resets_due_ > 0 && now - last_reset_ > 4.0 * repeat_time) {
            send_reset(now);
        }
        if (now - ending_since_ > settings_.greeting_time) {
            stage_ = Stage::alarm;
            message_ = "no Grbl answers at this port";
        }
        return;
    }
    const double patience = stage_ == Stage::homing ? homing_time : settings_.patience;
    if (now - last_heard_ <= patience || stage_ == Stage::alarm || stage_ == Stage::flushing) {
        return;
    }
    if (active()) {
        fail("the controller does not answer any more", now);
    } else if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        stage_ = Stage::alarm;
        message_ = "the controller does not answer any more";
    }
}

void Session::send_reset(double now) {
    output_ += reset_byte;
    ++resets_due_;
    last_reset_ = now;
    window_.clear();
    proof_.disturbed();
}

/// Brakes to rest, then empties the controller's buffers by a reset. Nothing else is sent in the meantime.
void Session::end(bool fault, std::string message, double now) {
    if (stage_ == Stage::braking || stage_ == Stage::flushing) {
        if (fault && !ending_in_fault_) {
            ending_in_fault_ = true;
            ending_message_ = std::move(message);
        }
        return;
    }
    stage_ = Stage::braking;
    ending_in_fault_ = fault;
    ending_message_ = std::move(message);
    ending_since_ = last_brake_ = now;
    rest_reports_ = 0;
    output_ = "!"; // whatever was to be sent is not sent any more
    next_poll_ = now;
}

void Session::fail(const std::string& message, double now) {
    if (active() || stage_ == Stage::braking) {
        end(true, message, now);
    }
}

void Session::watch_ending(double now) {
    if (stage_ == Stage::braking) {
        constexpr int enough_reports = 2;
        const bool given_up = now - ending_since_ > braking_time || now - last_heard_ > settings_.patience;
        if (rest_reports_ >= enough_reports || given_up) {
            stage_ = Stage::flushing;
            ending_since_ = now;
            send_reset(now);
        } else if (now - last_brake_ > repeat_time) {
            output_ += '!';
            last_brake_ = now;
        }
    } else if (stage_ == Stage::flushing) {
        if (now - ending_since_ > flushing_time) {
            ending_in_fault_ = true;
            ending_message_ += ending_message_.empty() ? "" : "; ";
            ending_message_ +=
                "the controller does not answer to a reset, so look whether the machine stands still";
            finish_ending();
        } else if (now - last_reset_ > 2.0 * repeat_time) {
            send_reset(now);
        }
    }
}

void Session::finish_ending() {
    stage_ = ending_in_fault_ ? Stage::alarm : Stage::stopped;
    message_ = ending_message_;
    hold_wanted_ = held_ = jog_stopping_ = false;
    window_.clear();
}

void Session::watch_hold(double now) {
    if (stage_ == Stage::running && hold_wanted_ && !held_ && now - hold_sent_ > repeat_time) {
        output_ += '!';
        hold_sent_ = now;
    }
}

void Session::watch_jog(double now) {
    if (stage_ != Stage::jogging) {
        return;
    }
    if (jog_until_ && now > *jog_until_) {
        stop_jog(now);
    }
    if (jog_stopping_ && now - last_brake_ > 0.5 * repeat_time) {
        output_ += jog_cancel_byte;
        last_brake_ = now;
    }
}

/// A line that is not answered although the machine stands still and dwells no longer has lost its answer.
void Session::watch_answers(double now) {
    if ((stage_ != Stage::running && stage_ != Stage::jogging) || window_.empty() || hold_wanted_ || held_ ||
        !report_ || report_->state != MachineState::idle) {
        last_answer_ = now;
        return;
    }
    double dwells = 0.0;
    for (const SentLine& line : window_.lines()) {
        dwells += line.dwell;
    }
    if (now - last_answer_ > answer_time + dwells) {
        fail("an acknowledgement was lost on the way, so that lines can no longer be told apart", now);
    }
}

/// Sends as much of the program as the controller has room for.
void Session::pump() {
    if (stage_ != Stage::running || hold_wanted_) {
        return;
    }
    while (next_line_ < std::ssize(program_.lines)) {
        const ProgramLine& line = program_.lines[static_cast<std::size_t>(next_line_)];
        std::string text = line.text + "\n";
        if (readout_.line_numbers && line.block < greatest_line_number) {
            text.insert(0, fmt::format("N{}", line.block + 1));
        }
        if (!window_.has_room_for(text.size())) {
            return;
        }
        output_ += text;
        window_.push({LineKind::program, std::move(text), next_line_, line.dwell});
        ++next_line_;
    }
}

void Session::require_rest(std::string_view what) const {
    if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        return;
    }
    throw Error(fmt::format("Grbl is {} and takes no {}", to_text(status().state), what),
                {},
                stage_ == Stage::alarm ? message_ + "; look at the machine, then reset it" : "");
}

void Session::start(ProgramLines program, double now) {
    require_rest("program");
    program_ = std::move(program);
    proof_ = Proof(program_, readout_.planner_blocks);
    window_ = Window(readout_.buffer_bytes, settings_.one_by_one);
    proof_closed_ = false;
    next_line_ = 0;
    stage_ = Stage::running;
    hold_wanted_ = held_ = false;
    resume_sent_ = -1.0;
    spare_welcomes_ = 0;
    message_.clear();
    last_answer_ = last_heard_ = now;
    next_poll_ = now;
    pump();
}

void Session::hold(double now) {
    if (stage_ == Stage::running && !hold_wanted_) {
        hold_wanted_ = true;
        held_ = false;
        hold_sent_ = now;
        output_ += '!';
    }
}

void Session::resume(double now) {
    if (stage_ == Stage::running && (hold_wanted_ || held_)) {
        hold_wanted_ = held_ = false;
        resume_sent_ = now;
        message_.clear();
        output_ += '~';
        pump();
    }
}

void Session::stop(double now) {
    const bool homing = stage_ == Stage::homing;
    if (active()) {
        end(false, {}, now);
    }
    if (homing) { // a homing cycle knows no hold
        stage_ = Stage::flushing;
        send_reset(now);
    }
}

void Session::emergency_stop(double now) {
    if (stage_ == Stage::closed) {
        return;
    }
    output_.clear();
    if (link_lost_) {
        return;
    }
    stage_ = Stage::flushing;
    ending_in_fault_ = true;
    ending_message_ = message_ = "emergency stop";
    ending_since_ = now;
    send_reset(now);
}

void Session::reset(double now) {
    if (stage_ == Stage::alarm && !link_lost_) {
        begin_asking(now, true);
    }
}

void Session::home(double now) {
    if (stage_ != Stage::alarm || link_lost_) {
        require_rest("homing");
    }
    program_ = {};
    proof_ = {};
    window_ = Window(readout_.buffer_bytes, true);
    window_.push({LineKind::home, "$H\n", -1, 0.0});
    output_ += "$H\n";
    stage_ = Stage::homing;
    message_.clear();
    last_heard_ = now;
}

void Session::jog(const Jog& jog, double now) {
    if (stage_ != Stage::jogging || jog_stopping_) {
        require_rest("jog");
    }
    constexpr double seconds_per_minute = 60.0;
    constexpr std::string_view letters = "XYZ";
    const bool usable = jog.way.size() <= 3 && jog.way.allFinite() && jog.way.norm() > 0.0 &&
                        jog.speed > 0.0 && std::isfinite(jog.speed) && jog.dead_man >= 0.0;
    expects(usable, "a jog goes somewhere in X, Y and Z at a speed");
    std::string text = "$J=G91G21";
    for (Eigen::Index n = 0; n < jog.way.size(); ++n) {
        text += std::abs(jog.way[n]) > 0.0 ? letters[static_cast<std::size_t>(n)] + fixed(jog.way[n], 4)
                                           : std::string();
    }
    text += "F" + fixed(std::max(0.001, jog.speed * seconds_per_minute), 3) + "\n";
    if (stage_ != Stage::jogging) {
        program_ = {};
        proof_ = {};
        window_ = Window(readout_.buffer_bytes, false);
        message_.clear();
        last_answer_ = last_heard_ = now;
        stage_ = Stage::jogging;
        rest_reports_ = 0;
        jog_stopping_ = false;
    }
    dead_man_ = jog.dead_man;
    jog_until_ = dead_man_ > 0.0 ? std::optional(now + dead_man_) : std::nullopt;
    if (window_.has_room_for(text.size())) { // else enough is under way
        output_ += text;
        window_.push({LineKind::jog, std::move(text), -1, 0.0});
        rest_reports_ = 0;
    }
}

void Session::stop_jog(double now) {
    if (stage_ == Stage::jogging && !jog_stopping_) {
        jog_stopping_ = true;
        jog_until_.reset();
        output_ += jog_cancel_byte;
        last_brake_ = now;
        next_poll_ = now;
    }
}

/// From the standard value on, so that it does not matter what is known of the present one.
void Session::set_overrides(const Overrides& wanted) {
    if (stage_ == Stage::closed || stage_ == Stage::greeting || stage_ == Stage::asking || link_lost_) {
        throw Error("Grbl is not connected and takes no overrides");
    }
    const auto steps = [this](int percent, char standard) {
        constexpr int least = 10;
        constexpr int most = 200;
        int difference = std::clamp(percent, least, most) - 100;
        output_ += standard;
        for (const int step : {10, -10, 1, -1}) {
            const int code = step == 10 ? 1 : step == -10 ? 2 : step == 1 ? 3 : 4;
            for (; step > 0 ? difference >= step : difference <= step; difference -= step) {
                output_ += static_cast<char>(standard + code);
            }
        }
    };
    steps(wanted.feed, '\x90');
    constexpr int above_half = 75;
    constexpr int above_quarter = 37;
    output_ += wanted.rapid > above_half ? '\x95' : wanted.rapid > above_quarter ? '\x96' : '\x97';
    steps(wanted.spindle, '\x99');
}

DriverStatus Session::status() const {
    DriverStatus status;
    status.message = message_;
    switch (stage_) {
    case Stage::closed:
    case Stage::greeting:
    case Stage::asking:
        return status;
    case Stage::ready:
        status.state = DriverState::idle;
        break;
    case Stage::running:
        status.state = hold_wanted_ || held_ ? DriverState::holding : DriverState::running;
        break;
    case Stage::jogging:
    case Stage::homing:
        status.state = DriverState::running;
        break;
    case Stage::braking:
        status.state = DriverState::stopping;
        break;
    case Stage::flushing:
        status.state = message_.empty() ? DriverState::stopping : DriverState::alarm;
        break;
    case Stage::stopped:
        status.state = DriverState::stopped;
        break;
    case Stage::alarm:
        status.state = DriverState::alarm;
        break;
    }
    status.position = kinematics::AxisPositions::Zero(3);
    status.velocity = kinematics::AxisPositions::Zero(3);
    for (std::size_t n = 0; n < readout_.offset.size(); ++n) {
        status.position[static_cast<Eigen::Index>(n)] = readout_.machine_position[n] - readout_.offset[n];
    }
    if (!program_.lines.empty() || program_.blocks > 0) {
        status.executed_blocks = proof_.executed_lines() > 0 || program_.lines.empty()
                                     ? program_.blocks_before(proof_.executed_lines())
                                     : 0;
        status.block = std::min(program_.blocks_before(proof_.executed_lines()), program_.blocks - 1);
    }
    constexpr double seconds_per_minute = 60.0;
    status.feed = report_ ? report_->feed.value_or(0.0) / seconds_per_minute : 0.0;
    status.spindle_rpm = report_ ? report_->spindle_rpm.value_or(0.0) : 0.0;
    status.overrides = overrides_;
    return status;
}

} // namespace millwright::machine::grbl
