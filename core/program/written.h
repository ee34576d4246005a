// Axis positions as they are written: rounded to the decimals of the listing, so that the listing, the
// planner and the virtual machine speak of the same numbers.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program_settings.h"

namespace millwright::program {

/// The digits that are written.
struct WrittenDigits {
    int length_decimals = 4;
    int angle_decimals = 4;   ///< of degrees
    double length_unit = 1.0; ///< mm
};

/// Rounded to the nearest written value, towards the inside where that would just leave a limit. Throws Error
/// naming `block`, axis, value and range where `positions` itself lies outside.
[[nodiscard]] kinematics::AxisPositions written(const kinematics::MachineModel& machine,
                                                const kinematics::AxisPositions& positions,
                                                const WrittenDigits& digits,
                                                int block);

[[nodiscard]] inline WrittenDigits digits_of(const ProgramSettings& settings) {
    return {settings.length_decimals, settings.angle_decimals, 1.0};
}

/// True if every axis is inside its limits (touching counts as inside).
[[nodiscard]] bool inside_limits(const kinematics::MachineModel& machine,
                                 const kinematics::AxisPositions& positions);

/// The duration of a move as it can be written in inverse time, never shorter than `duration`.
[[nodiscard]] double written_duration(double duration);

/// Digits of an inverse-time feed word.
inline constexpr int feed_decimals = 4;

} // namespace millwright::program
