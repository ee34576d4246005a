// The arm that a command is about, and its joints in the units of people.
#pragma once

#include "core/arm/arm_file.h"

#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
} // namespace CLI

namespace millwright::app {

/// Adds --arm to `command`; `arm` must live as long.
void add_arm_option(CLI::App& command, std::string& arm);

/// By its name or file. Throws Error for what is none.
[[nodiscard]] arm::ArmFile arm_file_of(const std::string& name);
[[nodiscard]] arm::ArmModel arm_of(const std::string& name);

/// Degrees or mm to rad or mm, and back.
[[nodiscard]] double to_joint(const arm::ArmModel& arm, int joint, double shown);
[[nodiscard]] double from_joint(const arm::ArmModel& arm, int joint, double position);

/// A position for every joint, as typed: degrees, mm of a sliding one. Throws Error for another count, and
/// for numbers that are not finite.
[[nodiscard]] arm::JointPositions given_joints(const arm::ArmModel& arm, const std::vector<double>& shown);

/// To a billionth, so that rounding does not show.
[[nodiscard]] double rounded(double value);

/// Every joint at 0, or at its limit that is nearest to it.
[[nodiscard]] arm::JointPositions resting(const arm::ArmModel& arm);

} // namespace millwright::app
