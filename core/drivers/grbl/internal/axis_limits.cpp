#include "core/drivers/grbl/internal/axis_limits.h"

#include "core/base/units.h"
#include "core/drivers/grbl/grbl_settings.h"
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <cctype>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

constexpr int status_mask = 10;
constexpr int homing_cycle = 22;
constexpr int homing_direction = 23;
constexpr int first_homing_pass = 44;
constexpr int last_homing_pass = 49;
constexpr int first_rate = 110;
constexpr int first_travel = 130;

std::optional<double> setting_of(const Readout& readout, int number) {
    const auto found = readout.settings.find(number);
    return found == readout.settings.end() ? std::nullopt : std::optional(found->second);
}

unsigned mask_of(const Readout& readout, int number) {
    return static_cast<unsigned>(setting_of(readout, number).value_or(0.0));
}

std::string named_item(const Readout& readout, std::size_t n, std::string_view item) {
    const auto letter = static_cast<char>(std::tolower(static_cast<unsigned char>(readout.axes[n])));
    const auto found = readout.named.find(fmt::format("/axes/{}/{}", letter, item));
    return found == readout.named.end() ? std::string() : found->second;
}

/// "A, B and C"
std::string listed(std::string_view letters) {
    std::string text;
    for (std::size_t n = 0; n < letters.size(); ++n) {
        text += n == 0 ? "" : n + 1 == letters.size() ? " and " : ", ";
        text += letters[n];
    }
    return text;
}

struct Interval {
    double min = 0.0, max = 0.0;
};

/// Where a homed axis of `travel` can go, in its units; nothing where the settings do not say that it homes.
std::optional<Interval> homed_interval(const Readout& readout, std::size_t n, double travel) {
    const unsigned axis = 1U << n;
    const unsigned homing = mask_of(readout, homing_cycle);
    if (readout.firmware == GrblFirmware::fluidnc) {
        const auto zero = read_number(named_item(readout, n, "homing/mpos_mm"));
        const auto cycle = read_number(named_item(readout, n, "homing/cycle"));
        const std::string positive = named_item(readout, n, "homing/positive_direction");
        if (!zero || !cycle || *cycle < 1.0 || positive.empty()) {
            return std::nullopt;
        }
        return positive == "true" ? Interval{*zero - travel, *zero} : Interval{*zero, *zero + travel};
    }
    if (readout.firmware == GrblFirmware::grblhal) {
        constexpr unsigned on = 1;
        constexpr unsigned zero_at_switches = 8;
        unsigned homed = 0;
        for (int pass = first_homing_pass; pass <= last_homing_pass; ++pass) {
            homed |= mask_of(readout, pass);
        }
        if ((homing & on) == 0 || (homed != 0 && (homed & axis) == 0)) {
            return std::nullopt;
        }
        const bool negative = (mask_of(readout, homing_direction) & axis) != 0;
        return (homing & zero_at_switches) != 0 && negative ? Interval{0.0, travel} : Interval{-travel, 0.0};
    }
    return homing > 0 ? std::optional(Interval{-travel, 0.0}) : std::nullopt;
}

} // namespace

MachineLimits machine_limits(const Readout& readout) {
    constexpr double seconds_per_minute = 60.0;
    MachineLimits limits;
    for (std::size_t n = 0; n < readout.axes.size() && !readout.settings.empty(); ++n) {
        const char letter = readout.axes[n];
        const bool turns = is_rotary_axis(letter);
        const auto ours = [turns](double value) { return turns ? from_degrees(value) : value; };
        MachineLimits::Axis axis{.letter = letter, .min = {}, .max = {}, .speed = {}};
        if (const auto rate = setting_of(readout, first_rate + static_cast<int>(n))) {
            axis.speed = ours(*rate) / seconds_per_minute;
        }
        const auto travel = setting_of(readout, first_travel + static_cast<int>(n));
        const bool ends = travel && (*travel > 0.0 || readout.firmware == GrblFirmware::grbl);
        if (const auto interval = ends ? homed_interval(readout, n, *travel) : std::nullopt) {
            axis.min = ours(interval->min);
            axis.max = ours(interval->max);
        } else if (ends && !turns) { // a rotary axis that does not home turns as far as it likes
            axis.travel = travel;
        }
        limits.axes.push_back(axis);
    }
    limits.spindle_rpm = setting_of(readout, 30);
    return limits;
}

std::vector<std::string> setup_remarks(const Readout& readout) {
    std::vector<std::string> remarks;
    if (readout.settings.empty()) {
        return remarks;
    }
    if (const auto reports = setting_of(readout, status_mask)) {
        const std::string_view advice = grbl_reports_advice(static_cast<int>(*reports), readout.firmware);
        if (!advice.empty()) {
            remarks.emplace_back(advice);
        }
    }
    std::string lengths, unknown, not_homed;
    const MachineLimits limits = machine_limits(readout);
    for (std::size_t n = 0; n < readout.axes.size(); ++n) {
        const MachineLimits::Axis& axis = limits.axes[n];
        const bool checked = (axis.min && axis.max) || axis.travel;
        const auto travel = setting_of(readout, first_travel + static_cast<int>(n));
        lengths.append(counts_as_length(readout, n) ? 1 : 0, readout.axes[n]);
        unknown.append(travel ? 0 : 1, readout.axes[n]);
        not_homed.append(!checked && travel && *travel > 0.0 ? 1 : 0, readout.axes[n]);
    }
    if (!lengths.empty()) {
        remarks.push_back(fmt::format("Setting $376 does not mark {} as rotary: a program in inches would "
                                      "rotate it 25.4 times too far. Add 1 for A, 2 for B, 4 for C to $376.",
                                      listed(lengths)));
    }
    if (!unknown.empty()) {
        remarks.push_back(fmt::format("The travel of {} is unknown, so no program is checked against it.",
                                      listed(unknown)));
    }
    if (!not_homed.empty()) {
        remarks.push_back(fmt::format("{} {} not home, so no program is checked against {} travel.",
                                      listed(not_homed),
                                      not_homed.size() > 1 ? "do" : "does",
                                      not_homed.size() > 1 ? "their" : "its"));
    }
    return remarks;
}

} // namespace millwright::drivers::grbl
