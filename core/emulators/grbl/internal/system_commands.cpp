// Lines that begin with $.
#include "core/base/text.h"
#include "core/emulators/grbl/internal/eeprom.h"
#include "core/emulators/grbl/internal/emulated_controller.h"
#include "core/emulators/grbl/internal/error_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <numeric>
#include <string>

namespace millwright::emulators::internal {

int EmulatedController::system_command(std::string_view line) {
    const bool at_work = state_ == State::run || state_ == State::hold;
    if (line == "$") {
        say("[HLP:$$ $# $G $I $N $x=val $Nx=line $J=line $SLP $C $X $H ~ ! ? ctrl-x]\r\n");
        return error_code::none;
    }
    if (line.starts_with("$J")) {
        return state_ != State::idle && state_ != State::jog ? error_code::not_idle
               : line.starts_with("$J=")                     ? jog(line.substr(3))
                                                             : error_code::bad_jog;
    }
    if (line == "$$") {
        if (at_work) {
            return error_code::not_idle;
        }
        say(settings_report(eeprom_, build_));
        return error_code::none;
    }
    if (line == "$G") {
        say(modes_report(modes_, eeprom_.is_on(report_inches_setting), build_) + "\r\n");
        return error_code::none;
    }
    if (line == "$C") {
        return check_mode();
    }
    if (line == "$X") {
        return unlock();
    }
    return state_ != State::idle && state_ != State::alarm ? error_code::not_idle : named_command(line);
}

int EmulatedController::named_command(std::string_view line) {
    if (line == "$#") {
        say(parameters_report(modes_, probe_, eeprom_, build_));
        return error_code::none;
    }
    if (line.starts_with("$H")) {
        return home(line);
    }
    if (line == "$SLP") {
        stop_everything();
        say(message("Sleeping", build_));
        state_ = State::sleep;
        line_.answer_due = true;
        acknowledge(error_code::none);
        return error_code::none;
    }
    if (line.starts_with("$I")) {
        return build_info(line);
    }
    if (line.starts_with("$RST=")) {
        return restore(line.substr(5));
    }
    if (line.starts_with("$N")) {
        return startup_line(line);
    }
    return line.starts_with("$/") ? named_setting(line) : store_setting(line);
}

int EmulatedController::jog(std::string_view line) {
    const Parsed parsed = parse_jog(line, modes_, eeprom_, build_);
    if (parsed.error != error_code::none) {
        return parsed.error;
    }
    if (eeprom_.is_on(soft_limits_setting) && !inside_travel(parsed.modes.position)) {
        return error_code::outside_travel;
    }
    state_ = State::jog;
    line_.owner = -1;
    line_.number = 0;
    take_over(parsed);
    return error_code::none;
}

int EmulatedController::check_mode() {
    if (state_ == State::check) {
        say(message("Disabled", build_));
        acknowledge(error_code::none);
        reset();
        return error_code::none;
    }
    if (state_ != State::idle) {
        return error_code::not_idle;
    }
    state_ = State::check;
    say(message("Enabled", build_));
    return error_code::none;
}

int EmulatedController::unlock() {
    if (state_ == State::alarm) {
        if (door_.open) {
            return error_code::door_open;
        }
        if (needs_homing()) {
            return error_code::homing_required;
        }
        last_alarm_ = 0;
        say(message("Caution: Unlocked", build_));
        state_ = State::idle;
    }
    return error_code::none;
}

int EmulatedController::home(std::string_view line) {
    if (line != "$H") {
        return error_code::unknown_command;
    }
    if (!eeprom_.is_on(homing_setting)) {
        return error_code::homing_off;
    }
    if (door_.open) {
        return error_code::door_open;
    }
    state_ = State::home;
    homing_.emplace(eeprom_, stepper_.position(), switches_broken_);
    return error_code::none;
}

int EmulatedController::build_info(std::string_view line) {
    const bool more = line == "$I+" && build_.is(EmulatedFirmware::grblhal);
    if (line == "$I" || more) {
        say(build_report(eeprom_, build_, options_.line_numbers, options_.printable_realtime));
        return error_code::none;
    }
    if (!line.starts_with("$I=")) {
        return error_code::unknown_command;
    }
    Eeprom next = eeprom_;
    next.build_text = line.substr(3);
    store(next);
    return error_code::none;
}

int EmulatedController::restore(std::string_view what) {
    const Eeprom fresh = default_eeprom(build_);
    Eeprom next = eeprom_;
    if (what == "$") {
        next.settings = fresh.settings;
    } else if (what == "#") {
        next.work_offsets = fresh.work_offsets;
        next.g28 = next.g30 = {};
    } else if (what == "*") {
        next = fresh;
    } else {
        return error_code::unknown_command;
    }
    pending_eeprom_ = next;
    line_.tasks.push_back({.action = Action::store});
    line_.tasks.push_back({.action = Action::restart});
    return error_code::none;
}

/// Grbl finds out whether a startup line is right by executing it.
int EmulatedController::startup_line(std::string_view line) {
    if (line == "$N") {
        say(fmt::format("$N0={}\r\n$N1={}\r\n", eeprom_.startup_lines[0], eeprom_.startup_lines[1]));
        return error_code::none;
    }
    if (!line.starts_with("$N0=") && !line.starts_with("$N1=")) {
        return error_code::unknown_command;
    }
    if (state_ != State::idle) {
        return error_code::not_idle;
    }
    const std::string_view code = line.substr(4);
    const Parsed parsed = parse_line(code, modes_, eeprom_, build_);
    if (parsed.error != error_code::none) {
        return parsed.error;
    }
    line_.owner = -1;
    line_.number = 0;
    take_over(parsed);
    pending_eeprom_ = eeprom_to_be();
    pending_eeprom_->startup_lines[line[2] == '0' ? 0 : 1] = code;
    line_.tasks.push_back({.action = Action::store});
    return error_code::none;
}

int EmulatedController::store_setting(std::string_view line) {
    line.remove_prefix(1);
    const std::size_t equals = line.find('=');
    int number = -1;
    const std::string_view name = line.substr(0, equals);
    const auto read_name = std::from_chars(name.data(), name.data() + name.size(), number);
    if (equals == std::string_view::npos || read_name.ec != std::errc{} ||
        read_name.ptr != name.data() + name.size()) {
        return error_code::unknown_command;
    }
    const std::string_view text = line.substr(equals + 1);
    double value = 0.0;
    const auto read =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    constexpr double most = 1e9;
    if (read.ec != std::errc{} || read.ptr != text.data() + text.size() || !(value > -most && value < most)) {
        return error_code::bad_number;
    }
    if (build_.is(EmulatedFirmware::fluidnc) && number != 10 && number != report_inches_setting) {
        return error_code::read_only_setting;
    }
    Eeprom next = eeprom_;
    const int error = next.set(number, value);
    if (error == error_code::none) {
        store(next);
    }
    return error;
}

namespace {

/// Grbl's number of what a FluidNC calls by a path, of axis `n` from 0; 0: it has none.
int number_of_item(std::string_view item, int n) {
    return item == "steps_per_mm"               ? 100 + n
           : item == "max_rate_mm_per_min"      ? 110 + n
           : item == "acceleration_mm_per_sec2" ? 120 + n
           : item == "max_travel_mm"            ? 130 + n
           : item == "homing/cycle"             ? homing_setting
                                                : 0;
}

} // namespace

/// $/axes/x/max_travel_mm of a FluidNC: a question, or with = a value that is in force at once.
int EmulatedController::named_setting(std::string_view line) {
    if (!build_.is(EmulatedFirmware::fluidnc)) {
        return error_code::unknown_command;
    }
    std::string name;
    for (const char c : line.substr(1, std::min(line.find('='), line.size()) - 1)) { // read in capitals
        name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    const auto answer = [&](std::string_view value) {
        say(fmt::format("${}={}\r\n", name, value));
        return error_code::none;
    };
    if (name == "/planner_blocks") {
        return answer(std::to_string(planner_.capacity() + 1));
    }
    if (name == "/stepping/segments") {
        return answer(std::to_string(sizes_of(build_.firmware).segments + 1));
    }
    constexpr std::string_view axes = "/axes/";
    const char letter = name.starts_with(axes) && name.size() > axes.size() + 2 ? name[axes.size()] : ' ';
    const std::size_t axis =
        build_.axes.find(static_cast<char>(std::toupper(static_cast<unsigned char>(letter))));
    if (axis == std::string::npos || name[axes.size() + 1] != '/') {
        return error_code::unknown_command;
    }
    const std::string item = name.substr(axes.size() + 2);
    const int number = number_of_item(item, static_cast<int>(axis));
    const bool homes = axis < 3;
    if (const std::size_t equals = line.find('='); equals != std::string_view::npos) {
        const std::string text(line.substr(equals + 1));
        double value = 0.0;
        const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
        if (number == 0 || read.ec != std::errc{} || (number == homing_setting && !homes)) {
            return error_code::no_such_setting;
        }
        Eeprom next = eeprom_;
        const int error = next.set(number, value);
        if (error == error_code::none) {
            store(next);
        }
        return error;
    }
    if (item == "homing/cycle") {
        return answer(homes && eeprom_.is_on(homing_setting) ? "1" : "0");
    }
    if (item == "homing/mpos_mm") {
        constexpr int direction_mask = 23;
        return answer(eeprom_.has_bit(direction_mask, axis) ? fixed(-eeprom_.axis_setting(130, axis), 3)
                                                            : std::string("0.000"));
    }
    if (item == "homing/positive_direction") {
        constexpr int direction_mask = 23;
        return answer(eeprom_.has_bit(direction_mask, axis) ? "false" : "true");
    }
    return number == 0 ? error_code::unknown_command : answer(fixed(eeprom_.setting(number), 3));
}

/// An AVR does nothing else meanwhile, and loses most of what comes over its serial line.
void EmulatedController::store(const Eeprom& eeprom) {
    const std::vector<double> pauses = eeprom_pauses(eeprom_, eeprom);
    eeprom_ = eeprom;
    if (!options_.eeprom_file.empty()) {
        write_eeprom(options_.eeprom_file, eeprom_);
    }
    if (pauses.empty() || !build_.is(EmulatedFirmware::grbl)) {
        return;
    }
    const double begin = std::max(time_, line_.arrived);
    writing_until_ = std::accumulate(pauses.begin(), pauses.end(), begin);
    serial_line_.interrupts_off(begin, pauses);
    lost_bytes_ += input_.lose([this](double arrived) { return !serial_line_.takes(arrived); });
}

} // namespace millwright::emulators::internal
