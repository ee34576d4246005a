#include "core/drivers/mdi_lines.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::drivers {

namespace {

constexpr int decimals = 4; // of mm and degrees: finer than any of these machines steps

double for_people(const program::ProgramAxis& axis, double value) {
    return axis.kind == kinematics::AxisKind::rotary ? to_degrees(value) : value;
}

} // namespace

std::string start_spindle(double rpm, bool clockwise) {
    expects(rpm >= 0.0 && std::isfinite(rpm), "a spindle's speed is not negative");
    return fmt::format("{} S{}", clockwise ? "M3" : "M4", fixed(rpm, 1));
}

std::string stop_spindle() {
    return "M5";
}

std::string set_coolant(bool mist, bool flood) {
    return std::string("M9") + (mist ? "\nM7" : "") + (flood ? "\nM8" : "");
}

std::string work_system_name(int system) {
    constexpr int first = 54;
    constexpr int plain_systems = 6; // G54 to G59; G59.1 to G59.3 follow
    expects(system >= 1 && system <= 9, "there are nine work coordinate systems");
    return system <= plain_systems ? fmt::format("G{}", first - 1 + system)
                                   : fmt::format("G59.{}", system - plain_systems);
}

std::string set_work_position(const program::ProgramAxis& axis, double value) {
    expects(std::isfinite(value), "a position is finite");
    return fmt::format("G21 G10 L20 P0 {}{}", axis.letter, fixed(for_people(axis, value), decimals));
}

std::string probe_line(
    const program::ProgramAxis& axis, int axis_index, double way, double speed, const DriverStatus& status) {
    const bool usable = std::isfinite(way) && std::abs(way) > 0.0 && std::isfinite(speed) && speed > 0.0;
    expects(usable && axis_index >= 0 && axis_index < status.position.size(), "a probing move has a length");
    constexpr double seconds_per_minute = 60.0;
    const double target = status.work_position()[axis_index] + way;
    return fmt::format("G21 G90 G94 G38.2 {}{} F{}",
                       axis.letter,
                       fixed(for_people(axis, target), decimals),
                       fixed(for_people(axis, speed) * seconds_per_minute, 3));
}

} // namespace millwright::drivers
