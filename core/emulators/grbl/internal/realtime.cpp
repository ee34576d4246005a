// The bytes that act at once, whatever the controller is doing.
#include "core/emulators/grbl/internal/emulated_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace millwright::emulators::internal {

namespace {

constexpr unsigned char reset_byte = 0x18;
constexpr unsigned char door_byte = 0x84;
constexpr unsigned char jog_cancel_byte = 0x85;
constexpr unsigned char first_override = 0x90;
constexpr unsigned char spindle_stop = 0x9E;
constexpr unsigned char toggle_flood = 0xA0;
constexpr unsigned char toggle_mist = 0xA1;
constexpr unsigned char first_extended = 0x80;

using OverrideFlags = std::bitset<override_bytes>;

/// Five flags from `first`: standard, +10, -10, +1, -1. All that are set count, in eight bits as Grbl counts.
int changed(int value, const OverrideFlags& flags, std::size_t first) {
    constexpr std::uint8_t least = 10;
    constexpr std::uint8_t most = 200;
    constexpr std::array<int, 5> steps = {0, 10, -10, 1, -1};
    value = flags[first] ? 100 : value;
    for (std::size_t n = 1; n < steps.size(); ++n) {
        value += flags[first + n] ? steps[n] : 0;
    }
    return std::clamp(static_cast<std::uint8_t>(value), least, most);
}

} // namespace

void EmulatedController::receive(unsigned char byte) {
    const double arrived = serial_line_.arrival(time_);
    if (!serial_line_.takes(arrived)) {
        ++lost_bytes_;
        return;
    }
    if (take_realtime(byte)) {
        return;
    }
    if (byte >= first_override && byte <= toggle_mist) {
        override_flags_.set(static_cast<std::size_t>(byte - first_override));
    } else if (byte >= first_extended) {
        return; // Grbl knows no more of them
    } else if (!input_.push(static_cast<char>(byte), arrived)) {
        ++lost_bytes_;
    }
}

/// False: it is no such character, or part of the text here.
bool EmulatedController::take_realtime(unsigned char byte) {
    const bool hal = build_.is(EmulatedFirmware::grblhal);
    const bool printable = !hal || options_.printable_realtime || !input_.in_system_line();
    switch (byte) {
    case reset_byte:
        reset();
        return true;
    case door_byte:
        open_door();
        return true;
    case jog_cancel_byte:
        if (hal) { // what waits there is never answered
            input_.clear();
        }
        if (state_ == State::jog) {
            cancel_jog();
        }
        return true;
    case '?':
        asked_ = printable ? std::max(asked_, StatusQuery::usual) : asked_;
        return printable;
    case '!':
        if (printable) {
            hold();
        }
        return printable;
    case '~':
        if (printable) {
            resume();
        }
        return printable;
    default:
        break;
    }
    constexpr unsigned char status_byte = 0x80;
    constexpr unsigned char resume_byte = 0x81;
    constexpr unsigned char hold_byte = 0x82;
    constexpr unsigned char all_byte = 0x87;
    if (!hal || byte < status_byte || byte > all_byte) {
        return false;
    }
    if (byte == status_byte || byte == all_byte) {
        asked_ = std::max(asked_, byte == all_byte ? StatusQuery::all : StatusQuery::usual);
    } else if (byte == resume_byte) {
        resume();
    } else if (byte == hold_byte) {
        hold();
    }
    return true;
}

/// A grblHAL whose $22 says so takes no G-code, and no $X, before it was homed.
bool EmulatedController::needs_homing() const {
    constexpr std::size_t at_start = 2;
    return build_.is(EmulatedFirmware::grblhal) && eeprom_.has_bit(homing_setting, 0) &&
           eeprom_.has_bit(homing_setting, at_start) && !homed_;
}

void EmulatedController::stop_everything() {
    const bool was_homing = homing_.has_value();
    if (was_homing) {
        stepper_.stand_at(homing_->position());
    }
    homing_.reset();
    stepper_.halt();
    planner_.clear();
    planner_.stand_at(stepper_.position());
    line_.tasks.clear();
    pending_eeprom_.reset();
    blocks_left_.clear();
    line_.answer_due = false;
    line_.dwell.reset();
    door_.restore.reset();
    trip_.reset();
    line_.probing = line_.paused = false;
    jog_cancel_ = false;
    spindle_stopped_ = false;
    modes_.spindle = 50;
    modes_.flood = modes_.mist = false;
    modes_.position = stepper_.position();
}

void EmulatedController::alarm(int code) {
    constexpr int hard_limit = 1;
    constexpr int soft_limit = 2;
    stop_everything();
    say(fmt::format("ALARM:{}\r\n", code));
    state_ = State::alarm;
    last_alarm_ = code;
    homed_ = homed_ && code == soft_limit;
    if (code == hard_limit || code == soft_limit) {
        say(message("Reset to continue", build_));
        critical_ = true;
    }
}

/// A probe that fails stops nothing but the motion.
void EmulatedController::probe_alarm(int code) {
    last_alarm_ = code;
    say(fmt::format("ALARM:{}\r\n", code));
    state_ = State::alarm;
}

void EmulatedController::reset() {
    constexpr int reset_in_motion = 3;
    constexpr int reset_while_homing = 6;
    if (homing_) {
        alarm(reset_while_homing);
    } else if (!stepper_.at_rest()) {
        alarm(reset_in_motion);
    }
    stop_everything();
    modes_ = {}; // G92 and G43.1 with them
    modes_.position = stepper_.position();
    probe_ = {};
    input_.clear();
    overrides_ = {};
    override_flags_.reset();
    planner_.set_overrides({});
    report_ = {};
    asked_ = StatusQuery::none;
    last_error_ = 0;
    critical_ = false;
    if (state_ != State::alarm && state_ != State::sleep) {
        state_ = State::idle;
    }
    greet();
}

void EmulatedController::power_on() {
    state_ = eeprom_.is_on(homing_setting) ? State::alarm : State::idle;
    stepper_.stand_at({});
    modes_ = {};
    homed_ = false;
    last_alarm_ = 0;
    if (build_.is(EmulatedFirmware::fluidnc)) { // its processor's boot loader speaks first
        say("ets Jul 29 2019 12:21:46\r\n\r\nrst:0x1 (POWERON_RESET),boot:0x13 (SPI_FAST_FLASH_BOOT)\r\n");
        say(message("FluidNC v3.7.12", build_));
    }
    reset();
}

void EmulatedController::greet() {
    switch (build_.firmware) {
    case EmulatedFirmware::grblhal:
        say("\r\nGrblHAL 1.1f ['$' or '$HELP' for help]\r\n");
        break;
    case EmulatedFirmware::fluidnc:
        say("\r\nGrbl 3.7 [FluidNC v3.7.12 (noradio) '$' for help]\r\n");
        break;
    case EmulatedFirmware::grbl:
        say("\r\nGrbl 1.1h ['$' for help]\r\n");
        break;
    }
    if (needs_homing()) {
        constexpr int homing_required = 11;
        state_ = State::alarm;
        last_alarm_ = homing_required;
        say(fmt::format("ALARM:{}\r\n", homing_required));
        say(message("Homing cycle required, $H to continue", build_));
        return;
    }
    if (state_ == State::alarm || state_ == State::sleep) {
        state_ = State::alarm;
        say(message("'$H'|'$X' to unlock", build_));
        return;
    }
    if (door_.open) {
        say(message("Check Door", build_));
        state_ = State::door;
        return;
    }
    run_startup_lines();
}

void EmulatedController::run_startup_lines() {
    for (const std::string& line : eeprom_.startup_lines) {
        if (line.empty()) {
            continue;
        }
        const Parsed parsed = parse_line(line, modes_, eeprom_to_be(), build_);
        if (parsed.error == 0) {
            line_.owner = -1;
            take_over(parsed);
        }
        say(parsed.error == 0 ? fmt::format(">{}:ok\r\n", line)
                              : fmt::format(">{}:error:{}\r\n", line, parsed.error));
    }
}

void EmulatedController::hold() {
    if (state_ == State::jog) {
        cancel_jog();
    } else if (state_ == State::idle || state_ == State::run) {
        state_ = State::hold;
        stepper_.hold();
    }
}

void EmulatedController::cancel_jog() {
    jog_cancel_ = true;
    stepper_.hold();
    after_motion();
}

void EmulatedController::resume() {
    const bool ready = stepper_.at_rest() || stepper_.held();
    if (!ready) {
        return;
    }
    if (state_ == State::hold || state_ == State::tool) {
        spindle_stopped_ = false;
        stepper_.resume();
        state_ = planner_.empty() ? State::idle : State::run;
        start_cycle();
    } else if (state_ == State::door && !door_.open && !door_.restore) {
        constexpr double spindle_delay = 4.0;
        constexpr double coolant_delay = 1.0;
        const double delay = (modes_.spindle != 50 ? spindle_delay : 0.0) +
                             (modes_.flood || modes_.mist ? coolant_delay : 0.0);
        door_.restore = time_ + delay;
        after_motion();
    }
}

void EmulatedController::open_door() {
    constexpr int door_while_homing = 7;
    if (homing_) {
        alarm(door_while_homing);
        reset();
        return;
    }
    if (state_ == State::idle || state_ == State::hold || state_ == State::run || state_ == State::jog) {
        jog_cancel_ = state_ == State::jog;
        state_ = State::door;
        stepper_.hold();
        if (door_.open) {
            say(message("Check Door", build_));
        }
        after_motion();
    }
}

void EmulatedController::set_door(bool open) {
    const bool opened = open && !door_.open;
    door_.open = open;
    if (opened) {
        open_door();
    }
}

void EmulatedController::hit_limit_switch() {
    constexpr int hard_limits = 21;
    if (eeprom_.is_on(hard_limits)) {
        raise_alarm();
    }
}

void EmulatedController::raise_alarm() {
    constexpr int hit = 1;
    if (!critical_) {
        alarm(hit);
    }
}

/// In one pass of the main loop: bytes that came more than once in between count once.
void EmulatedController::take_overrides() {
    constexpr std::size_t feed = 0;
    constexpr std::size_t rapid = 5;
    constexpr std::size_t spindle = 9;
    const OverrideFlags flags = std::exchange(override_flags_, {});
    const Overrides before = overrides_;
    overrides_.feed = changed(overrides_.feed, flags, feed);
    constexpr std::array<int, 3> levels = {100, 50, 25};
    for (std::size_t n = 0; n < levels.size(); ++n) {
        overrides_.rapid = flags[rapid + n] ? levels[n] : overrides_.rapid;
    }
    overrides_.spindle = changed(overrides_.spindle, flags, spindle);
    if (!(overrides_ == before)) {
        planner_.set_overrides({overrides_.feed, overrides_.rapid});
        report_.show_overrides_next();
    }
    for (const unsigned char byte : {spindle_stop, toggle_flood, toggle_mist}) {
        if (flags[static_cast<std::size_t>(byte - first_override)]) {
            change_accessory(byte);
        }
    }
}

void EmulatedController::change_accessory(unsigned char byte) {
    const bool possible = state_ == State::idle || state_ == State::run || state_ == State::hold;
    if (byte == spindle_stop && state_ == State::hold && stepper_.at_rest()) {
        spindle_stopped_ = !spindle_stopped_;
    } else if (byte == toggle_flood && possible) {
        modes_.flood = !modes_.flood;
    } else if (byte == toggle_mist && options_.mist && possible) {
        modes_.mist = !modes_.mist;
    } else {
        return;
    }
    report_.show_overrides_next();
}

std::string_view EmulatedController::state_text() const {
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
        return door_.restore ? "Door:3" : !stepper_.at_rest() ? "Door:2" : door_.open ? "Door:1" : "Door:0";
    case State::check:
        return "Check";
    case State::home:
        return "Home";
    case State::sleep:
        return "Sleep";
    case State::tool:
        return "Tool";
    }
    return "Idle";
}

void EmulatedController::report_status() {
    Snapshot now;
    now.state = state_text();
    now.position = stepper_.position();
    now.offset = work_offset(modes_, eeprom_);
    now.free_blocks = planner_.free_blocks();
    now.free_bytes = input_.free_bytes();
    now.line_number = (options_.line_numbers || build_.is(EmulatedFirmware::grblhal)) && !planner_.empty()
                          ? planner_.first().move.line_number
                          : 0;
    now.feed = stepper_.speed() * seconds_per_minute;
    const bool checks = state_ == State::check; // nothing is switched
    const bool turning = modes_.spindle != 50 && !spindle_stopped_ && state_ != State::door && !checks;
    constexpr double percent = 0.01;
    constexpr int most_rpm = 30, least_rpm = 31; // settings
    const double asked = modes_.spindle_rpm * overrides_.spindle * percent;
    now.spindle_rpm = turning && asked > 0.0
                          ? std::clamp(asked,
                                       std::min(eeprom_.setting(least_rpm), eeprom_.setting(most_rpm)),
                                       eeprom_.setting(most_rpm))
                          : 0.0;
    now.pins.append(door_.open ? 1 : 0, 'D');
    now.overrides = overrides_;
    now.accessories.append(turning ? 1 : 0, modes_.spindle == 30 ? 'S' : 'C');
    now.accessories.append(modes_.flood && !checks ? 1 : 0, 'F');
    now.accessories.append(modes_.mist && !checks ? 1 : 0, 'M');
    now.alarm = last_alarm_;
    now.all = std::exchange(asked_, StatusQuery::none) == StatusQuery::all;
    now.homed = homed_;
    now.tool = modes_.tool;
    now.work_system += modes_.coordinates;
    say(report_.text(now, eeprom_, build_, state_ != State::idle && state_ != State::alarm));
}

} // namespace millwright::emulators::internal
