// The bytes that act at once, whatever the controller is doing.
#include "core/machine/emulators/grbl/internal/controller.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::machine::emulated {

namespace {

constexpr unsigned char reset_byte = 0x18;
constexpr unsigned char door_byte = 0x84;
constexpr unsigned char jog_cancel_byte = 0x85;
constexpr unsigned char first_override = 0x90;
constexpr unsigned char last_override = 0x9D;
constexpr unsigned char spindle_stop = 0x9E;
constexpr unsigned char toggle_flood = 0xA0;
constexpr unsigned char toggle_mist = 0xA1;
constexpr unsigned char first_extended = 0x80;
constexpr double seconds_per_minute = 60.0;

void change(int& value, unsigned command) {
    constexpr int least = 10;
    constexpr int most = 200;
    constexpr std::array<int, 5> steps = {0, 10, -10, 1, -1};
    value = command == 0 ? 100 : std::clamp(value + steps[command], least, most);
}

} // namespace

void Controller::receive(unsigned char byte) {
    switch (byte) {
    case reset_byte:
        reset();
        return;
    case '?':
        status_asked_ = true;
        return;
    case '!':
        hold();
        return;
    case '~':
        resume();
        return;
    case door_byte:
        open_door();
        return;
    case jog_cancel_byte:
        if (state_ == State::jog) {
            cancel_jog();
        }
        return;
    default:
        break;
    }
    if (byte >= first_override && byte <= last_override) {
        change_override(byte);
    } else if (byte >= first_extended) {
        change_accessory(byte);
    } else if (!input_.push(static_cast<char>(byte))) {
        ++lost_bytes_;
    }
}

void Controller::stop_everything() {
    const bool was_homing = homing_.has_value();
    if (was_homing) {
        stepper_.stand_at(homing_->position());
    }
    homing_.reset();
    stepper_.halt();
    planner_.clear();
    planner_.stand_at(stepper_.position());
    tasks_.clear();
    blocks_left_.clear();
    answer_due_ = false;
    dwell_.reset();
    door_restore_.reset();
    trip_.reset();
    probing_ = paused_ = false;
    jog_cancel_ = false;
    spindle_stopped_ = false;
    modes_.spindle = 50;
    modes_.flood = modes_.mist = false;
    modes_.position = stepper_.position();
}

void Controller::alarm(int code) {
    constexpr int hard_limit = 1;
    constexpr int soft_limit = 2;
    stop_everything();
    say(fmt::format("ALARM:{}\r\n", code));
    state_ = State::alarm;
    if (code == hard_limit || code == soft_limit) {
        say("[MSG:Reset to continue]\r\n");
        critical_ = true;
    }
}

void Controller::reset() {
    constexpr int reset_in_motion = 3;
    constexpr int reset_while_homing = 6;
    if (homing_) {
        alarm(reset_while_homing);
    } else if (!stepper_.at_rest()) {
        alarm(reset_in_motion);
    }
    stop_everything();
    const Modes before = modes_;
    modes_ = {};
    modes_.position = before.position;
    modes_.g92 = before.g92;
    input_.clear();
    overrides_ = {};
    planner_.set_overrides({});
    report_ = {};
    status_asked_ = false;
    critical_ = false;
    if (state_ != State::alarm && state_ != State::sleep) {
        state_ = State::idle;
    }
    greet();
}

void Controller::power_on() {
    constexpr int homing_enabled = 22;
    state_ = eeprom_.is_on(homing_enabled) ? State::alarm : State::idle;
    stepper_.stand_at({});
    modes_ = {};
    reset();
}

void Controller::greet() {
    say("\r\nGrbl 1.1h ['$' for help]\r\n");
    if (state_ == State::alarm || state_ == State::sleep) {
        state_ = State::alarm;
        say("[MSG:'$H'|'$X' to unlock]\r\n");
        return;
    }
    if (door_open_) {
        say("[MSG:Check Door]\r\n");
        state_ = State::door;
        return;
    }
    run_startup_lines();
}

void Controller::run_startup_lines() {
    for (const std::string& line : eeprom_.startup_lines) {
        if (line.empty()) {
            continue;
        }
        const Parsed parsed = parse_line(line, modes_, eeprom_);
        if (parsed.error == 0) {
            line_owner_ = -1;
            take_over(parsed);
        }
        say(parsed.error == 0 ? fmt::format(">{}:ok\r\n", line)
                              : fmt::format(">{}:error:{}\r\n", line, parsed.error));
    }
}

void Controller::hold() {
    if (state_ == State::jog) {
        cancel_jog();
    } else if (state_ == State::idle || state_ == State::run) {
        state_ = State::hold;
        stepper_.hold();
    }
}

void Controller::cancel_jog() {
    jog_cancel_ = true;
    stepper_.hold();
    after_motion();
}

void Controller::resume() {
    const bool ready = stepper_.at_rest() || stepper_.held();
    if (!ready) {
        return;
    }
    if (state_ == State::hold) {
        spindle_stopped_ = false;
        stepper_.resume();
        state_ = planner_.empty() ? State::idle : State::run;
        start_cycle();
    } else if (state_ == State::door && !door_open_ && !door_restore_) {
        constexpr double spindle_delay = 4.0;
        constexpr double coolant_delay = 1.0;
        const double delay = (modes_.spindle != 50 ? spindle_delay : 0.0) +
                             (modes_.flood || modes_.mist ? coolant_delay : 0.0);
        door_restore_ = time_ + delay;
        after_motion();
    }
}

void Controller::open_door() {
    constexpr int door_while_homing = 7;
    if (homing_) {
        alarm(door_while_homing);
        return;
    }
    if (state_ == State::idle || state_ == State::hold || state_ == State::run || state_ == State::jog) {
        jog_cancel_ = state_ == State::jog;
        state_ = State::door;
        stepper_.hold();
        if (door_open_) {
            say("[MSG:Check Door]\r\n");
        }
        after_motion();
    }
}

void Controller::set_door(bool open) {
    const bool opened = open && !door_open_;
    door_open_ = open;
    if (opened) {
        open_door();
    }
}

void Controller::hit_limit_switch() {
    constexpr int hard_limits = 21;
    if (eeprom_.is_on(hard_limits)) {
        raise_alarm();
    }
}

void Controller::raise_alarm() {
    constexpr int hit = 1;
    if (!critical_) {
        alarm(hit);
    }
}

void Controller::change_override(unsigned char byte) {
    const unsigned command = byte - first_override;
    constexpr unsigned rapid = 5;
    constexpr unsigned spindle = 9;
    if (command < rapid) {
        change(overrides_.feed, command);
    } else if (command < rapid + 3) {
        constexpr std::array<int, 3> levels = {100, 50, 25};
        overrides_.rapid = levels[command - rapid];
    } else if (command >= spindle) {
        change(overrides_.spindle, command - spindle);
    }
    planner_.set_overrides({overrides_.feed, overrides_.rapid});
    report_.show_overrides_next();
}

void Controller::change_accessory(unsigned char byte) {
    const bool possible = state_ == State::idle || state_ == State::run || state_ == State::hold;
    if (byte == spindle_stop && state_ == State::hold && stepper_.at_rest()) {
        spindle_stopped_ = !spindle_stopped_;
    } else if (byte == toggle_flood && possible) {
        modes_.flood = !modes_.flood;
    } else if (byte == toggle_mist && possible) {
        modes_.mist = !modes_.mist;
    } else {
        return;
    }
    report_.show_overrides_next();
}

std::string_view Controller::state_text() const {
    switch (state_) {
    case State::idle:
        return "Idle";
    case State::run:
        return "Run";
    case State::hold:
        return stepper_.at_rest() ? "Hold:0" : "Hold:1";
    case State::jog:
        return "Jog";
    case State::alarm:
        return "Alarm";
    case State::door:
        return door_restore_ ? "Door:3" : !stepper_.at_rest() ? "Door:2" : door_open_ ? "Door:1" : "Door:0";
    case State::check:
        return "Check";
    case State::home:
        return "Home";
    case State::sleep:
        return "Sleep";
    }
    return "Idle";
}

void Controller::report_status() {
    Snapshot now;
    now.state = state_text();
    now.position = stepper_.position();
    now.offset = work_offset(modes_, eeprom_);
    now.free_blocks = planner_.free_blocks();
    now.free_bytes = input_.free_bytes();
    now.line_number = options_.line_numbers && !planner_.empty() ? planner_.first().move.line_number : 0;
    now.feed = stepper_.speed() * seconds_per_minute;
    const bool turning = modes_.spindle != 50 && !spindle_stopped_ && state_ != State::door;
    constexpr double percent = 0.01;
    now.spindle_rpm = turning ? modes_.spindle_rpm * overrides_.spindle * percent : 0.0;
    now.pins.append(door_open_ ? 1 : 0, 'D');
    now.overrides = overrides_;
    now.accessories.append(turning ? 1 : 0, modes_.spindle == 30 ? 'S' : 'C');
    now.accessories.append(modes_.flood ? 1 : 0, 'F');
    now.accessories.append(modes_.mist ? 1 : 0, 'M');
    say(report_.text(now, eeprom_, state_ != State::idle && state_ != State::alarm));
}

} // namespace millwright::machine::emulated
