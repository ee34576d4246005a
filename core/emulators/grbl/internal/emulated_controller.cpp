#include "core/emulators/grbl/internal/emulated_controller.h"

#include "core/emulators/grbl/internal/error_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace millwright::emulators::internal {

namespace {

constexpr double line_time = 0.0003; // s: the real one reads about three thousand lines per second
constexpr double never = std::numeric_limits<double>::max();

} // namespace

EmulatedController::EmulatedController(GrblEmulatorOptions options)
    : options_(std::move(options)), build_{options_.firmware, options_.axes, options_.mist},
      eeprom_(read_eeprom(options_.eeprom_file, build_)),
      planner_(eeprom_, sizes_of(build_.firmware).planner_blocks),
      stepper_(
          planner_, sizes_of(build_.firmware).segments, [this](std::int64_t owner) { block_done(owner); }),
      input_(sizes_of(build_.firmware).receive_bytes,
             sizes_of(build_.firmware).longest_line,
             build_.is(EmulatedFirmware::fluidnc)) {
    power_on();
}

std::string EmulatedController::take_output() {
    return std::exchange(output_, {});
}

Truth EmulatedController::truth() const {
    Truth truth;
    truth.lines.assign(truth_.begin(), truth_.end());
    truth.travelled = stepper_.travelled();
    truth.last_motion = last_motion_;
    truth.lost_bytes = lost_bytes_;
    return truth;
}

void EmulatedController::advance(double seconds) {
    work();
    for (double rest = seconds; rest > 0.0;) {
        const double segment = state_ == State::idle ? 0.0 : stepper_.next_event();
        const double step = std::min({rest, next_event() - time_, segment > 0.0 ? segment : never});
        pass(step);
        time_ += step;
        rest -= step;
        after_motion();
        work();
    }
}

/// The next time at which something happens without input, apart from the end of a segment.
double EmulatedController::next_event() const {
    double next = never;
    const auto consider = [&](double time) { next = time > time_ ? std::min(next, time) : next; };
    consider(busy_until_);
    consider(writing_until_);
    if (line_.dwell) {
        consider(*line_.dwell);
    }
    if (door_.restore) {
        consider(*door_.restore);
    }
    if (homing_) {
        consider(time_ + homing_->rest());
    }
    return next;
}

void EmulatedController::pass(double seconds) {
    if (homing_) {
        homing_->advance(seconds);
        last_motion_ = time_ + seconds;
        return;
    }
    if (stepper_.at_rest()) {
        return;
    }
    const Axes before = stepper_.position();
    stepper_.advance(seconds);
    if (stepper_.position() != before) {
        last_motion_ = time_ + seconds;
    }
    watch_probe(before);
    watch_limits();
}

void EmulatedController::after_motion() {
    constexpr double rounding = 1e-9;
    if (homing_ && homing_->rest() < rounding) {
        const Homing done = *homing_;
        homing_.reset();
        stepper_.stand_at(done.position());
        modes_.position = done.position();
        if (done.failed()) {
            constexpr int switch_not_found = 9;
            alarm(switch_not_found);
            reset(); // as the real one does, which greets then
        } else {
            state_ = State::idle;
            homed_ = true;
            report_.show_offset_next();
            run_startup_lines(); // the answer to $H follows when these are done
        }
    }
    if (door_.restore && time_ >= *door_.restore - rounding) {
        door_.restore.reset();
        state_ = stepper_.at_rest() && planner_.empty() ? State::idle : State::run;
        stepper_.resume();
    }
    if (jog_cancel_ && stepper_.at_rest()) {
        jog_cancel_ = false;
        if (build_.is(EmulatedFirmware::fluidnc) && !line_.tasks.empty()) {
            acknowledge(error_code::jog_cancelled);
        }
        line_.tasks.clear();
        stepper_.halt();
        modes_.position = stepper_.position();
        state_ = state_ == State::door ? State::door : State::idle;
    }
    if (trip_ && stepper_.at_rest()) {
        alarm(*std::exchange(trip_, std::nullopt));
    }
    if (line_.probing && stepper_.at_rest() && (probe_.touched || planner_.empty())) {
        finish_probe(probe_.touched);
    }
    const bool finished = stepper_.at_rest() && planner_.empty();
    if (finished && (state_ == State::run || state_ == State::jog)) {
        state_ = State::idle;
    }
}

/// Grbl's main loop, until it has nothing to do or has to wait.
void EmulatedController::work() {
    while (!writing()) {
        if (asked_ != StatusQuery::none && !homing_ && !critical_) {
            report_status();
        }
        if (override_flags_.any() && !homing_ && !critical_) {
            take_overrides();
        }
        const bool suspended =
            state_ == State::hold || state_ == State::door || state_ == State::tool || jog_cancel_ || trip_;
        if (critical_ || suspended || homing_ || state_ == State::sleep) {
            return;
        }
        if (line_.answer_due || !line_.tasks.empty()) {
            if (!do_tasks()) {
                return;
            }
            continue;
        }
        if (input_.empty()) {
            start_cycle();
            return;
        }
        if (time_ < busy_until_) {
            return;
        }
        if (const auto line = input_.take_line()) {
            busy_until_ = time_ + line_time;
            execute(*line);
        }
    }
}

void EmulatedController::execute(const InputLine& line) {
    constexpr int too_long = 11;
    constexpr int locked = 9;
    if (line.too_long) {
        last_error_ = build_.is(EmulatedFirmware::grblhal) ? too_long : 0;
        acknowledge(too_long);
        return;
    }
    if (options_.echo) {
        say(fmt::format("[echo:{}]\r\n", line.text));
    }
    line_.answer_due = true;
    line_.arrived = line.arrived;
    int error = 0;
    if (line.text.starts_with('$')) {
        error = system_command(line.text);
    } else if (!line.text.empty()) {
        error = state_ == State::alarm || state_ == State::jog ? locked
                : last_error_ != 0                             ? last_error_
                                                               : execute_gcode(line.text);
    }
    last_error_ = build_.is(EmulatedFirmware::grblhal) ? error : 0;
    if (error != 0) {
        line_.answer_due = false;
        line_.tasks.clear();
        acknowledge(error);
    }
}

int EmulatedController::execute_gcode(const std::string& text) {
    const Parsed parsed = parse_line(text, modes_, eeprom_, build_);
    if (parsed.error != 0) {
        return parsed.error;
    }
    if (options_.keep_truth && state_ != State::check) {
        truth_.push_back({text, time_, -1.0});
        line_.owner = static_cast<std::int64_t>(truth_.size()) - 1;
        blocks_left_[line_.owner] = 1; // the line itself, until all of its tasks are done
    }
    line_.number = parsed.line_number;
    take_over(parsed);
    return 0;
}

void EmulatedController::acknowledge(int error) {
    line_.answer_due = false;
    say(error == 0 ? std::string("ok\r\n") : fmt::format("error:{}\r\n", error));
}

/// Planned motion begins when there is nothing left to read, or when a line has to wait for it.
void EmulatedController::start_cycle() {
    if (state_ == State::idle && !planner_.empty()) {
        state_ = State::run;
    }
    if (state_ == State::run || state_ == State::jog) {
        (void)stepper_.next_event();
    }
}

void EmulatedController::watch_limits() {
    constexpr int hard_limits = 21;
    constexpr int travel = 130;
    constexpr int hit = 1;
    if (!eeprom_.is_on(hard_limits)) {
        return;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double at = stepper_.position()[axis];
        constexpr double switch_travel = 0.001;
        if (at > switch_travel || at < -eeprom_.axis_setting(travel, axis) - switch_travel) {
            alarm(hit);
            return;
        }
    }
}

void EmulatedController::watch_probe(const Axes& before) {
    if (!line_.probing || probe_.touched || !options_.surface) {
        return;
    }
    const bool toward = modes_.motion == 382 || modes_.motion == 383;
    const auto above = [&](const Axes& at) { return at[2] - options_.surface(at[0], at[1]); };
    const auto triggered = [&](const Axes& at) { return (above(at) <= 0.0) == toward; };
    Axes near = before;
    Axes far = stepper_.position();
    if (!triggered(far)) {
        return;
    }
    constexpr int halvings = 40;
    for (int n = 0; n < halvings; ++n) {
        Axes middle = near;
        for (std::size_t axis = 0; axis < middle.size(); ++axis) {
            middle[axis] = 0.5 * (near[axis] + far[axis]);
        }
        (triggered(middle) ? far : near) = middle;
    }
    probe_.touched = true;
    probe_.position = far;
    stepper_.hold();
}

} // namespace millwright::emulators::internal
