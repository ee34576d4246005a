// What a line makes an emulated Grbl do, piece by piece; each piece is tried until there is room for it.
#include "core/base/numbers.h"
#include "core/emulators/grbl/internal/emulated_controller.h"

#include <utility>

namespace millwright::emulators::internal {

namespace {

/// Nothing moves in check mode ($C). The real one looks at its soft limits all the same, stores offsets, and
/// ends programs.
bool acts_in_check_mode(const Task& task) {
    return task.action == Action::move || task.action == Action::store || task.action == Action::end;
}

} // namespace

void EmulatedController::take_over(const Parsed& parsed) {
    modes_ = parsed.modes;
    for (const Task& task : parsed.tasks) {
        if (state_ == State::check && !acts_in_check_mode(task)) {
            continue;
        }
        line_.tasks.push_back(task);
        if (task.action == Action::store) {
            pending_eeprom_ = parsed.eeprom; // nothing is read before this line is done
        }
    }
}

/// Whether the line is done; then it is acknowledged.
bool EmulatedController::do_tasks() {
    while (!line_.tasks.empty()) {
        if (writing()) {
            return false;
        }
        if (!do_task(line_.tasks.front())) {
            start_cycle();
            return false;
        }
        if (line_.tasks.empty()) { // an alarm has taken them away
            return true;
        }
        line_.tasks.pop_front();
    }
    if (writing()) {
        return false;
    }
    if (line_.answer_due) {
        acknowledge(0);
    }
    block_done(line_.owner);
    line_.owner = -1;
    return true;
}

bool EmulatedController::do_task(Task& task) {
    switch (task.action) {
    case Action::move:
        return do_move(task);
    case Action::probe:
        return do_probe(task);
    case Action::dwell:
        return do_dwell(task);
    case Action::store:
        if (!at_rest()) {
            return false;
        }
        if (pending_eeprom_) {
            store(*std::exchange(pending_eeprom_, std::nullopt));
        }
        return true;
    case Action::offset: // the real one counts by it from its parsing on, and says so when it is at rest
        if (!at_rest()) {
            return false;
        }
        report_.show_offset_next();
        return true;
    case Action::pause:
        if (!at_rest()) {
            return false;
        }
        line_.paused = !line_.paused;
        state_ = line_.paused ? State::hold : state_;
        return !line_.paused;
    case Action::tool:
        if (!at_rest()) {
            return false;
        }
        line_.paused = !line_.paused;
        state_ = line_.paused ? State::tool : state_;
        return !line_.paused;
    case Action::restart:
        say(message("Restoring defaults", build_));
        acknowledge(0);
        reset();
        return true;
    case Action::end:
        if (!at_rest()) {
            return false;
        }
        end_program();
        return true;
    case Action::spindle:
    case Action::coolant:
        if (!at_rest()) {
            return false;
        }
        report_.show_overrides_next();
        return true;
    }
    return true;
}

bool EmulatedController::writing() const {
    constexpr double rounding = 1e-9;
    return time_ < writing_until_ - rounding;
}

bool EmulatedController::at_rest() {
    return planner_.empty() && stepper_.at_rest();
}

bool EmulatedController::inside_travel(const Axes& target) const {
    constexpr int travel = 130;
    for (std::size_t axis = 0; axis < build_.axis_count(); ++axis) {
        const double at = target[axis];
        const double length = eeprom_.axis_setting(travel, axis);
        if (axis >= 3 && !build_.is(EmulatedFirmware::grbl) && !(length > 0.0)) {
            continue; // without end
        }
        if (!(at <= 0.0 && at >= -length)) {
            return false;
        }
    }
    return true;
}

bool EmulatedController::do_move(Task& task) {
    const double points = static_cast<double>(task.points.size());
    while (task.next < task.points.size()) {
        if (eeprom_.is_on(soft_limits_setting) && state_ != State::jog &&
            !inside_travel(task.points[task.next])) {
            constexpr int soft_limit = 2;
            if (stepper_.at_rest()) {
                alarm(soft_limit);
                return true;
            }
            trip_ = soft_limit;
            stepper_.hold();
            return false;
        }
        if (state_ == State::check) {
            ++task.next;
            continue;
        }
        if (planner_.free_blocks() == 0) {
            return false;
        }
        const Move move{.target = task.points[task.next],
                        .rapid = task.rapid,
                        .overridable = state_ != State::jog,
                        .rate = task.rate / seconds_per_minute * (task.inverse_time ? points : 1.0),
                        .inverse_time = task.inverse_time,
                        .line_number = line_.number,
                        .owner = line_.owner};
        if (planner_.add(move) && line_.owner >= 0) {
            ++blocks_left_[line_.owner];
        }
        ++task.next;
    }
    return true;
}

bool EmulatedController::do_dwell(const Task& task) {
    if (!line_.dwell) {
        if (!at_rest()) {
            return false;
        }
        line_.dwell = time_ + task.seconds;
    }
    constexpr double rounding = 1e-9;
    if (time_ < *line_.dwell - rounding) {
        return false;
    }
    line_.dwell.reset();
    return true;
}

bool EmulatedController::do_probe(const Task& task) {
    if (line_.probing || !at_rest()) {
        return false;
    }
    const Axes& at = stepper_.position();
    const bool toward = task.probe == 382 || task.probe == 383;
    const bool touching = options_.surface && at[2] <= options_.surface(at[0], at[1]);
    probe_.touched = false; // where it touched last is kept
    if (touching == toward) {
        constexpr int wrong_beginning = 4;
        probe_alarm(wrong_beginning);
        return true;
    }
    line_.probing = planner_.add({.target = task.points.front(),
                                  .overridable = false,
                                  .rate = task.rate / seconds_per_minute,
                                  .inverse_time = task.inverse_time,
                                  .line_number = line_.number,
                                  .owner = -1});
    return !line_.probing;
}

void EmulatedController::finish_probe(bool touched) {
    line_.probing = false;
    stepper_.halt();
    const bool must = modes_.motion == 382 || modes_.motion == 384;
    modes_.position = stepper_.position();
    if (!touched) {
        if (must) {
            constexpr int nothing_touched = 5;
            probe_alarm(nothing_touched);
        } else {
            probe_.position = stepper_.position();
        }
    }
    say(probe_report(probe_, eeprom_, build_));
    if (!line_.tasks.empty()) {
        line_.tasks.pop_front();
    }
    state_ = state_ == State::run ? State::idle : state_;
}

/// M2 and M30 set some modes back.
void EmulatedController::end_program() {
    modes_.motion = 10;
    modes_.plane = 170;
    modes_.absolute = true;
    modes_.inverse_time = false;
    modes_.coordinates = 0;
    modes_.spindle = 50;
    modes_.flood = modes_.mist = false;
    overrides_.feed = overrides_.rapid = overrides_.spindle = 100;
    planner_.set_overrides({});
    report_.show_overrides_next();
    report_.show_offset_next();
    say(message(build_.is(EmulatedFirmware::fluidnc) ? "Program End" : "Pgm End", build_));
}

void EmulatedController::block_done(std::int64_t owner) {
    const auto left = blocks_left_.find(owner);
    if (left == blocks_left_.end() || --left->second > 0) {
        return;
    }
    blocks_left_.erase(left);
    truth_[static_cast<std::size_t>(owner)].executed = time_;
}

} // namespace millwright::emulators::internal
