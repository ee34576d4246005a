#include "core/drivers/grbl/internal/messages.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::drivers::grbl {

namespace {

template <class Number> std::optional<Number> whole_number(std::string_view text) {
    Number value{};
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    return !text.empty() && read.ec == std::errc{} && read.ptr == text.data() + text.size()
               ? std::optional(value)
               : std::nullopt;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
    std::vector<std::string_view> parts;
    while (true) {
        const std::size_t end = std::min(text.find(separator), text.size());
        parts.push_back(text.substr(0, end));
        if (end == text.size()) {
            return parts;
        }
        text.remove_prefix(end + 1);
    }
}

template <std::size_t count> std::optional<std::array<int, count>> integers(std::string_view text) {
    const auto parts = split(text, ',');
    std::array<int, count> result{};
    if (parts.size() != count) {
        return std::nullopt;
    }
    for (std::size_t n = 0; n < count; ++n) {
        const auto value = whole_number<int>(parts[n]);
        if (!value || *value < 0) {
            return std::nullopt;
        }
        result[n] = *value;
    }
    return result;
}

bool read_state(std::string_view text, StatusMessage& status) {
    struct Name {
        std::string_view text;
        MachineState state;
    };
    constexpr std::array names = {Name{"Idle", MachineState::idle},
                                  Name{"Run", MachineState::run},
                                  Name{"Hold", MachineState::hold},
                                  Name{"Jog", MachineState::jog},
                                  Name{"Alarm", MachineState::alarm},
                                  Name{"Door", MachineState::door},
                                  Name{"Check", MachineState::check},
                                  Name{"Home", MachineState::home},
                                  Name{"Sleep", MachineState::sleep},
                                  Name{"Tool", MachineState::tool}};
    const std::size_t colon = std::min(text.find(':'), text.size());
    const auto* found = std::ranges::find(names, text.substr(0, colon), &Name::text);
    if (found == names.end()) {
        return false;
    }
    status.state = found->state;
    if (colon == text.size()) {
        return true;
    }
    const auto sub_state = whole_number<int>(text.substr(colon + 1));
    status.sub_state = sub_state.value_or(-1);
    return sub_state && *sub_state >= 0;
}

bool read_speeds(std::string_view text, StatusMessage& status) {
    const auto parts = split(text, ',');
    status.feed = read_number(parts[0]);
    status.spindle_rpm = parts.size() > 1 ? read_number(parts[1]) : std::nullopt;
    return status.feed && (parts.size() == 1 || status.spindle_rpm);
}

bool is_field_name(std::string_view name) {
    return !name.empty() && std::ranges::all_of(name, [](unsigned char c) {
        return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    });
}

/// False if the field is known and wrong.
bool read_field(std::string_view field, StatusMessage& status) {
    const std::size_t colon = std::min(field.find(':'), field.size());
    const std::string_view name = field.substr(0, colon);
    const std::string_view value = field.substr(std::min(colon + 1, field.size()));
    if (name == "MPos") {
        return (status.machine_position = read_axes(value)).has_value();
    }
    if (name == "WPos") {
        return (status.work_position = read_axes(value)).has_value();
    }
    if (name == "WCO") {
        return (status.offset = read_axes(value)).has_value();
    }
    if (name == "Bf") {
        const auto free = integers<2>(value);
        if (free) {
            status.free_blocks = (*free)[0];
            status.free_bytes = (*free)[1];
        }
        return free.has_value();
    }
    if (name == "Ln") {
        const auto line = whole_number<int>(value);
        status.line = line;
        return line && *line > 0;
    }
    if (name == "F" || name == "FS") {
        return read_speeds(value, status);
    }
    if (name == "Ov") {
        return (status.overrides = integers<3>(value)).has_value();
    }
    if (name == "Pn") {
        status.pins = value;
        return true;
    }
    if (name == "A") {
        status.accessories = value;
        return true;
    }
    status.foreign_fields = true;
    return is_field_name(name);
}

Message read_status(std::string_view line) {
    const auto fields = split(line.substr(1, line.size() - 2), '|');
    StatusMessage status;
    if (!read_state(fields.front(), status)) {
        return Garbage{};
    }
    for (std::size_t n = 1; n < fields.size(); ++n) {
        if (!read_field(fields[n], status)) {
            return Garbage{};
        }
    }
    if (!status.machine_position && !status.work_position) {
        return Garbage{};
    }
    if (status.overrides && !status.accessories) {
        status.accessories.emplace(); // left out if all is off
    }
    return status;
}

Message read_setting(std::string_view line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
        return Garbage{};
    }
    if (line.starts_with("$N")) {
        return Feedback{"N", std::string(line.substr(2))};
    }
    const std::string_view name = line.substr(1, equals - 1);
    const auto which = whole_number<int>(name);
    const auto value = read_number(line.substr(equals + 1));
    if (which && value) {
        return SettingMessage{*which, *value};
    }
    if (which || name.starts_with('/')) {
        return NamedSetting{std::string(name), std::string(line.substr(equals + 1))};
    }
    return Garbage{};
}

Message read_feedback(std::string_view line) {
    const std::string_view inside = line.substr(1, line.size() - 2);
    const std::size_t colon = inside.find(':');
    if (colon == std::string_view::npos) {
        return Garbage{};
    }
    return Feedback{std::string(inside.substr(0, colon)), std::string(inside.substr(colon + 1))};
}

} // namespace

std::optional<double> read_number(std::string_view text) {
    double value = 0.0;
    const auto read =
        std::from_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed);
    const bool plain = std::ranges::all_of(
        text, [](char c) { return std::string_view("-.0123456789").find(c) != std::string_view::npos; });
    return plain && !text.empty() && read.ec == std::errc{} && read.ptr == text.data() + text.size() &&
                   std::isfinite(value)
               ? std::optional(value)
               : std::nullopt;
}

std::optional<Axes> read_axes(std::string_view text) {
    constexpr std::size_t least_axes = 3;
    constexpr std::size_t most_axes = 9;
    const auto parts = split(text, ',');
    if (parts.size() < least_axes || parts.size() > most_axes) {
        return std::nullopt;
    }
    Axes result;
    for (const std::string_view part : parts) {
        const auto value = read_number(part);
        if (!value) {
            return std::nullopt;
        }
        result.push_back(*value);
    }
    return result;
}

bool StatusMessage::moving() const {
    const bool braking = (state == MachineState::hold && sub_state != 0) ||
                         (state == MachineState::door && sub_state != 0 && sub_state != 1);
    return braking || state == MachineState::run || state == MachineState::jog || state == MachineState::home;
}

Message read_message(std::string_view line) {
    constexpr std::string_view error = "error:";
    constexpr std::string_view alarm = "ALARM:";
    if (line.empty()) {
        return Blank{};
    }
    if (line == "ok") {
        return Ack{};
    }
    if (line.starts_with(error) || line.starts_with(alarm)) {
        const auto code = whole_number<int>(line.substr(error.size()));
        if (!code || *code <= 0) {
            return Garbage{};
        }
        return line.starts_with(error) ? Message(ErrorAnswer{*code}) : Message(AlarmMessage{*code});
    }
    if (auto who = read_greeting(line)) {
        return Welcome{std::move(*who)};
    }
    const bool pair = line.size() >= 2;
    if (pair && line.front() == '<' && line.back() == '>') {
        return read_status(line);
    }
    if (pair && line.front() == '[' && line.back() == ']') {
        return read_feedback(line);
    }
    if (line.front() == '$') {
        return read_setting(line);
    }
    if (line.front() == '>') {
        return StartupLine{line.ends_with(":ok")};
    }
    return Garbage{};
}

std::optional<ProbeResult> read_probe_result(std::string_view text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string_view::npos) {
        return std::nullopt;
    }
    const auto position = read_axes(text.substr(0, colon));
    const std::string_view touched = text.substr(colon + 1);
    if (!position || (touched != "0" && touched != "1")) {
        return std::nullopt;
    }
    return ProbeResult{*position, touched == "1"};
}

} // namespace millwright::drivers::grbl
