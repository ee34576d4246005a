// Arms and joint positions for tests.
#pragma once

#include "core/arm/arm_file.h"
#include "core/base/units.h"

#include <algorithm>
#include <initializer_list>
#include <random>
#include <string>

namespace millwright::test {

inline arm::ArmModel arm(const std::string& name) {
    return arm::read_arm("assets/arms/" + name + ".json").arm;
}

/// The same arm with a tool of that length along its axis.
inline arm::ArmModel with_tool(const arm::ArmModel& arm, double length) {
    arm::ArmDescription description = arm.description();
    description.tool_tip = {0.0, 0.0, length};
    return arm::ArmModel(description);
}

inline arm::JointPositions degrees(std::initializer_list<double> values) {
    arm::JointPositions positions(static_cast<Eigen::Index>(values.size()));
    std::ranges::transform(values, positions.begin(), from_degrees);
    return positions;
}

/// Anywhere inside the limits, at most `share` of each range from its middle.
inline arm::JointPositions random_joints(std::mt19937& random, const arm::ArmModel& arm, double share = 1.0) {
    arm::JointPositions positions(arm.joint_count());
    for (int n = 0; n < arm.joint_count(); ++n) {
        const double middle = 0.5 * (arm.joint(n).min + arm.joint(n).max);
        const double half = 0.5 * share * (arm.joint(n).max - arm.joint(n).min);
        positions[n] = std::uniform_real_distribution<double>(middle - half, middle + half)(random);
    }
    return positions;
}

} // namespace millwright::test
