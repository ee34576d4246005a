#include "core/program/number_format.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace millwright::program {

double NumberFormat::digit() const {
    return std::pow(10.0, -decimals);
}

double NumberFormat::rounded(double value) const {
    return std::strtod(fixed(value, decimals).c_str(), nullptr);
}

std::string NumberFormat::text(double value) const {
    std::string text = fixed(value, decimals);
    if (!trailing_zeros && decimals > 0) {
        text.erase(text.find_last_not_of('0') + 1);
        if (!point && text.back() == '.') {
            text.pop_back();
        }
    } else if (decimals == 0 && point) {
        text += '.';
    }
    const bool negative = text.front() == '-';
    const std::size_t first = negative ? 1 : 0;
    const bool zero_before_digits = text.size() > first + 2 && text[first] == '0' && text[first + 1] == '.';
    if (!leading_zero && zero_before_digits) {
        text.erase(first, 1);
    }
    return plus && !negative ? "+" + text : text;
}

using kinematics::AxisKind;
using kinematics::AxisPositions;
using kinematics::MachineAxis;
using kinematics::MachineModel;

namespace {

constexpr double touching = 1e-9; // mm or rad: rounding of the inverse kinematics at a limit

double for_people(const MachineAxis& axis, double position) {
    return axis.kind == AxisKind::rotary ? to_degrees(position) : position;
}

double from_people(const MachineAxis& axis, double shown) {
    return axis.kind == AxisKind::rotary ? from_degrees(shown) : shown;
}

bool inside(const MachineAxis& axis, double position) {
    return position >= axis.min - touching && position <= axis.max + touching;
}

[[noreturn]] void outside(const MachineAxis& axis, double position, int block) {
    throw Error(fmt::format("block {}: axis {} would have to move to {:.3f}, outside {:.3f} ... {:.3f} {}",
                            block + 1,
                            axis.letter,
                            for_people(axis, position),
                            for_people(axis, axis.min),
                            for_people(axis, axis.max),
                            axis.kind == AxisKind::rotary ? "deg" : "mm"),
                {},
                "move the part on the table, or lower the clearances of the program");
}

double rounded(const MachineAxis& axis, double position, const WrittenDigits& digits) {
    const bool rotary = axis.kind == AxisKind::rotary;
    const double unit = rotary ? 1.0 : digits.length_unit;
    const double scale = std::pow(10.0, rotary ? digits.angle_decimals : digits.length_decimals);
    const double steps = std::round(for_people(axis, position) / unit * scale);
    const auto at = [&](double count) { return from_people(axis, count / scale * unit); };
    const double nearest = at(steps);
    if (nearest > axis.max) {
        return at(steps - 1.0);
    }
    return nearest < axis.min ? at(steps + 1.0) : nearest;
}

} // namespace

AxisPositions
written(const MachineModel& machine, const AxisPositions& positions, const WrittenDigits& digits, int block) {
    AxisPositions result = positions;
    for (int n = 0; n < machine.axis_count(); ++n) {
        const MachineAxis& axis = machine.axis(n);
        if (!inside(axis, positions[n])) {
            outside(axis, positions[n], block);
        }
        result[n] = rounded(axis, positions[n], digits);
    }
    return result;
}

bool inside_limits(const MachineModel& machine, const AxisPositions& positions) {
    for (int n = 0; n < machine.axis_count(); ++n) {
        if (!inside(machine.axis(n), positions[n])) {
            return false;
        }
    }
    return true;
}

double written_duration(double duration) {
    constexpr double seconds_per_minute = 60.0;
    const double scale = std::pow(10.0, feed_decimals);
    const double steps = std::max(1.0, std::floor(seconds_per_minute / duration * scale));
    return seconds_per_minute / (steps / scale);
}

} // namespace millwright::program
