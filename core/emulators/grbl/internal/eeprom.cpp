#include "core/emulators/grbl/internal/eeprom.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/emulators/grbl/internal/error_codes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::emulators::internal {

Sizes sizes_of(EmulatedFirmware firmware) {
    switch (firmware) {
    case EmulatedFirmware::grblhal:
        return {.planner_blocks = 35, .segments = 9, .receive_bytes = 1024, .longest_line = 256};
    case EmulatedFirmware::fluidnc:
        return {.planner_blocks = 15, .segments = 11, .receive_bytes = 128, .longest_line = 255};
    case EmulatedFirmware::grbl:
        break;
    }
    return {};
}

namespace {

constexpr double shortest_pulse = 3.0; // us
constexpr std::array<std::string_view, 8> offset_names = {
    "G54", "G55", "G56", "G57", "G58", "G59", "G28", "G30"};

Axes& offset(Eeprom& eeprom, std::size_t n) {
    return n < 6 ? eeprom.work_offsets[n] : (n == 6 ? eeprom.g28 : eeprom.g30);
}

std::optional<double> number(std::string_view text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole =
        read.ec == std::errc{} && read.ptr == text.data() + text.size() && std::isfinite(value);
    return whole ? std::optional(value) : std::nullopt;
}

bool read_offset(std::string_view text, std::size_t count, Axes& axes) {
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t comma = std::min(text.find(','), text.size());
        const auto value = number(text.substr(0, comma));
        if (!value) {
            return false;
        }
        axes[n] = *value;
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return text.empty();
}

bool read_setting(std::string_view name, std::string_view value, Eeprom& eeprom) {
    const auto which = number(name);
    const auto read = number(value);
    return which && read && eeprom.set(static_cast<int>(*which), *read) == 0;
}

bool read_line(std::string_view line, Eeprom& eeprom) {
    const std::size_t equals = line.find('=');
    if (equals == std::string_view::npos) {
        return false;
    }
    const std::string_view name = line.substr(0, equals);
    const std::string_view value = line.substr(equals + 1);
    if (name == "$N0" || name == "$N1") {
        eeprom.startup_lines[name == "$N0" ? 0 : 1] = value;
        return true;
    }
    if (name == "$I") {
        eeprom.build_text = value;
        return true;
    }
    if (name.starts_with('$')) {
        return read_setting(name.substr(1), value, eeprom);
    }
    const auto* found = std::ranges::find(offset_names, name);
    return found != offset_names.end() &&
           read_offset(value,
                       eeprom.axis_count,
                       offset(eeprom, static_cast<std::size_t>(found - offset_names.begin())));
}

} // namespace

std::vector<Setting> default_settings(const Build& build) {
    std::vector<Setting> settings = {
        {0, 10, 0},    {1, 25, 0},     {2, 0, 0},      {3, 0, 0},      {4, 0, 0},     {5, 0, 0},
        {6, 0, 0},     {10, 1, 0},     {11, 0.01, 3},  {12, 0.002, 3}, {13, 0, 0},    {20, 0, 0},
        {21, 0, 0},    {22, 0, 0},     {23, 0, 0},     {24, 25, 3},    {25, 500, 3},  {26, 250, 0},
        {27, 1, 3},    {30, 1000, 0},  {31, 0, 0},     {32, 0, 0},     {100, 250, 3}, {101, 250, 3},
        {102, 250, 3}, {110, 3000, 3}, {111, 3000, 3}, {112, 3000, 3}, {120, 200, 3}, {121, 200, 3},
        {122, 200, 3}, {130, 200, 3},  {131, 200, 3},  {132, 200, 3}};
    for (std::size_t axis = 3; axis < build.axis_count(); ++axis) {
        const int n = static_cast<int>(axis);
        settings.insert(settings.end(), {{100 + n, 100, 3}, {110 + n, 3600, 3}, {120 + n, 360, 3}});
        settings.push_back({130 + n, build.is(EmulatedFirmware::grbl) ? 360.0 : 0.0, 3});
    }
    if (build.is(EmulatedFirmware::grblhal)) {
        constexpr double all_reports = 511.0;
        std::ranges::find(settings, 10, &Setting::number)->value = all_reports;
        settings.insert(settings.end(),
                        {{44, 4, 0}, // Z homes first, then X and Y; no other axis does
                         {45, 3, 0},
                         {341, 0, 0},
                         {rotary_mask_setting, 0, 0},
                         {planner_blocks_setting, 35, 0}});
    }
    std::ranges::sort(settings, {}, &Setting::number);
    return settings;
}

Eeprom default_eeprom(const Build& build) {
    Eeprom eeprom;
    eeprom.settings = default_settings(build);
    eeprom.axis_count = build.axis_count();
    return eeprom;
}

double Eeprom::setting(int number) const {
    const auto found = std::ranges::find(settings, number, &Setting::number);
    expects(found != settings.end(), "Grbl has this setting");
    return found->value;
}

int Eeprom::set(int number, double value) {
    const auto found = std::ranges::find(settings, number, &Setting::number);
    if (value < 0.0) {
        return error_code::negative_value;
    }
    if (found == settings.end()) {
        return error_code::unknown_command;
    }
    if (number == 0 && value < shortest_pulse) {
        return error_code::short_step_pulse;
    }
    if (number == soft_limits_setting && value > 0.0 && !is_on(homing_setting)) {
        return error_code::soft_limits_without_homing;
    }
    found->value = found->decimals == 0 ? std::floor(value) : value;
    if (number == homing_setting && !is_on(homing_setting)) {
        (void)set(soft_limits_setting, 0.0);
    }
    return 0;
}

Eeprom read_eeprom(const std::filesystem::path& file, const Build& build) {
    Eeprom eeprom = default_eeprom(build);
    if (file.empty() || !std::filesystem::exists(file)) {
        return eeprom;
    }
    const std::string text = read_file(file);
    std::string_view rest = text;
    // Soft limits need homing_setting, whichever comes first: $22 stands after $20 in the file.
    (void)eeprom.set(homing_setting, 1.0);
    bool homing_told = false;
    for (int line_number = 1; !rest.empty(); ++line_number) {
        const std::size_t length = std::min(rest.find('\n'), rest.size());
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(std::min(length + 1, rest.size()));
        homing_told = homing_told || line.starts_with("$22=");
        if (!line.empty() && !read_line(line, eeprom)) {
            throw Error(Diagnostic{.place = {file, line_number, 0, -1},
                                   .message = "'" + std::string(line) + "' is not a Grbl setting",
                                   .hint = {}});
        }
    }
    if (!homing_told) {
        (void)eeprom.set(homing_setting, 0.0);
    }
    return eeprom;
}

void write_eeprom(const std::filesystem::path& file, const Eeprom& eeprom) {
    std::string text;
    for (const Setting& setting : eeprom.settings) {
        text += fmt::format("${}={}\n", setting.number, fixed(setting.value, setting.decimals));
    }
    Eeprom copy = eeprom;
    for (std::size_t n = 0; n < offset_names.size(); ++n) {
        const Axes& axes = offset(copy, n);
        text += fmt::format("{}=", offset_names[n]);
        for (std::size_t axis = 0; axis < eeprom.axis_count; ++axis) {
            text += shortest(axes[axis]) + (axis + 1 < eeprom.axis_count ? "," : "\n");
        }
    }
    text += fmt::format(
        "$N0={}\n$N1={}\n$I={}\n", eeprom.startup_lines[0], eeprom.startup_lines[1], eeprom.build_text);
    write_file(file, text);
}

namespace {

constexpr double erase_and_write_time = 3.4e-3; // data sheet of the ATmega328P
constexpr double erase_or_write_time = 1.8e-3;
constexpr std::size_t eeprom_line_size = 80;

using Record = std::vector<std::uint8_t>;

void append(Record& record, double value) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    for (unsigned shift = 0; shift < 32; shift += 8) {
        record.push_back(static_cast<std::uint8_t>(bits >> shift));
    }
}

Record settings_record(const Eeprom& eeprom) {
    Record record;
    for (const Setting& setting : eeprom.settings) {
        if (setting.decimals > 0) {
            append(record, setting.value);
        } else {
            record.push_back(static_cast<std::uint8_t>(static_cast<std::int64_t>(setting.value)));
        }
    }
    return record;
}

Record offset_record(const Axes& axes, std::size_t count) {
    Record record;
    for (std::size_t n = 0; n < count; ++n) {
        append(record, axes[n]);
    }
    return record;
}

Record line_record(const std::string& text) {
    Record record(eeprom_line_size, 0);
    std::copy_n(text.begin(), std::min(text.size(), record.size()), record.begin());
    return record;
}

/// Each record is followed by a checksum of its bytes.
std::vector<Record> records_of(const Eeprom& eeprom) {
    std::vector<Record> records{settings_record(eeprom)};
    for (const Axes& offset : eeprom.work_offsets) {
        records.push_back(offset_record(offset, eeprom.axis_count));
    }
    records.push_back(offset_record(eeprom.g28, eeprom.axis_count));
    records.push_back(offset_record(eeprom.g30, eeprom.axis_count));
    for (const std::string& line : eeprom.startup_lines) {
        records.push_back(line_record(line));
    }
    records.push_back(line_record(eeprom.build_text));
    for (Record& record : records) {
        std::uint8_t checksum = 0;
        for (const std::uint8_t byte : record) {
            checksum = static_cast<std::uint8_t>((checksum << 1U) + (checksum >> 7U) + byte);
        }
        record.push_back(checksum);
    }
    return records;
}

/// Bits are cleared by writing and set by erasing the whole byte; only a byte that needs both takes longer.
double write_time(std::uint8_t before, std::uint8_t after) {
    constexpr std::uint8_t erased = 0xff;
    const bool erases = (~before & after) != 0;
    return erases && after != erased ? erase_and_write_time : erase_or_write_time;
}

} // namespace

std::vector<double> eeprom_pauses(const Eeprom& before, const Eeprom& after) {
    std::vector<double> pauses;
    const std::vector<Record> old_records = records_of(before);
    const std::vector<Record> new_records = records_of(after);
    for (std::size_t n = 0; n < new_records.size(); ++n) {
        for (std::size_t byte = 0; byte + 1 < new_records[n].size(); ++byte) {
            if (old_records[n][byte] != new_records[n][byte]) {
                pauses.push_back(write_time(old_records[n][byte], new_records[n][byte]));
            }
        }
    }
    return pauses;
}

} // namespace millwright::emulators::internal
