// How a control wants numbers written.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/program/program_settings.h"

#include <string>

namespace millwright::program {

struct NumberFormat {
    int decimals = 4;           ///< 0 to 6
    bool plus = false;          ///< + before what is not negative
    bool leading_zero = true;   ///< 0.5, not .5
    bool trailing_zeros = true; ///< 1.500, not 1.5
    bool point = true;          ///< also behind whole numbers: 1., not 1

    /// The value of the last digit.
    [[nodiscard]] double digit() const;
    /// `value` at the nearest number that can be written; a zero is not negative. Throws Defect if `value` is
    /// not finite.
    [[nodiscard]] double rounded(double value) const;
    /// The text of rounded(value).
    [[nodiscard]] std::string text(double value) const;

    friend bool operator==(const NumberFormat&, const NumberFormat&) = default;
};

// Axis positions as they are written: rounded to the decimals of the listing, so that the listing, the
// planner and the virtual machine speak of the same numbers.

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
