#include "core/pmac/driver/internal/motor_readings.h"

#include "core/base/units.h"
#include "core/pmac/driver/internal/card_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace millwright::pmac::internal {

namespace {

constexpr double volt_per_bit = 10.0 / 32768.0;
constexpr double ms = 1e-3;
/// Of each motor: active, output address, fatal following error, software limits, greatest velocity and
/// acceleration, jog speed, homing speed, flags, clamp.
constexpr std::array<int, 11> asked{0, 2, 11, 13, 14, 16, 17, 22, 23, 25, 69};

} // namespace

MotorReadings::MotorReadings(std::vector<PmacAxis> axes)
    : axes_(std::move(axes)), outputs_(axes_.size(), -1), jog_speeds_(axes_.size()),
      ways_home_(axes_.size(), 1.0), protections_(axes_.size()) {
    for (const PmacAxis& axis : axes_) {
        drivers::MachineLimits::Axis limits;
        limits.letter = axis.letter;
        limits_.push_back(limits);
    }
}

double MotorReadings::radians(std::size_t axis, double counts) const {
    return from_degrees(counts / axes_[axis].counts_per_degree);
}

std::string MotorReadings::rating_line(std::size_t axis) const {
    std::string line;
    for (const int variable : asked) {
        line += fmt::format("I{}{:02}", axes_[axis].motor, variable);
    }
    return line;
}

void MotorReadings::read_rating(std::size_t axis, const std::vector<std::string>& lines) {
    std::array<double, asked.size()> values{};
    if (lines.size() != asked.size()) {
        return give_up();
    }
    for (std::size_t n = 0; n < asked.size(); ++n) {
        const auto value = card_number(lines[n]);
        if (!value) {
            return give_up();
        }
        values[n] = *value;
    }
    const auto& [active, address, error, high, low, velocity, acceleration, jog, home, flags, clamp] = values;
    outputs_[axis] = static_cast<int>(std::clamp(address, 0.0, 1e7)) & 0xFFFF; // bit 16: sign and magnitude
    drivers::MachineLimits::Axis& limits = limits_[axis];
    const auto limit = [&](double counts) { // 0: switched off
        return std::abs(counts) > 0.0 ? std::optional(radians(axis, counts)) : std::nullopt;
    };
    limits.max = limit(high);
    limits.min = limit(low);
    limits.speed = radians(axis, velocity / ms);
    limits.acceleration = radians(axis, acceleration / (ms * ms));
    jog_speeds_[axis] = jog;
    ways_home_[axis] = home < 0.0 ? -1.0 : 1.0;
    limits.output_V = clamp * volt_per_bit;
    const auto bits = static_cast<std::uint32_t>(std::clamp(flags, 0.0, 16'777'215.0));
    protections_[axis] = MotorProtections{axes_[axis].motor, error, high, low, bits, active > 0.0};
}

std::vector<std::string> MotorReadings::protections_off() const {
    std::vector<MotorProtections> motors;
    for (const auto& motor : protections_) {
        if (!motor) {
            return {"the card did not report whether they are on"};
        }
        motors.push_back(*motor);
    }
    return pmac::protections_off(motors);
}

std::string MotorReadings::reading_line() const {
    if (!told_ || std::ranges::find(outputs_, -1) != outputs_.end()) {
        return {};
    }
    std::string line;
    for (std::size_t n = 0; n < axes_.size(); ++n) {
        line += fmt::format("#{}FRY${:X}", axes_[n].motor, outputs_[n]);
    }
    return line;
}

void MotorReadings::read(const std::vector<std::string>& lines) {
    if (lines.size() != 2 * axes_.size()) {
        return give_up();
    }
    std::vector<drivers::MotorReading> motors(axes_.size());
    for (std::size_t n = 0; n < axes_.size(); ++n) {
        const auto error = card_number(lines[2 * n]), word = card_number(lines[2 * n + 1]);
        if (!error || !word || *word < 0.0 || *word > 0xFFFFFF) {
            return give_up();
        }
        constexpr int below = 8;
        const auto bits = static_cast<std::int16_t>(static_cast<std::uint32_t>(*word) >> below);
        motors[n] = {radians(n, *error), bits * volt_per_bit};
    }
    motors_ = std::move(motors);
}

std::vector<drivers::MachineLimits::Axis> MotorReadings::limits() const {
    std::vector<drivers::MachineLimits::Axis> limits = limits_;
    for (std::size_t n = 0; n < limits.size(); ++n) {
        if (jog_speeds_[n]) {
            limits[n].jog_speed = radians(n, *jog_speeds_[n] / ms);
        }
        if (const auto most = axes_[n].max_deg) {
            limits[n].max = std::min(limits[n].max.value_or(from_degrees(*most)), from_degrees(*most));
        }
        if (const auto least = axes_[n].min_deg) {
            limits[n].min = std::max(limits[n].min.value_or(from_degrees(*least)), from_degrees(*least));
        }
    }
    return limits;
}

} // namespace millwright::pmac::internal
