#include "app/command_line/arm_choice.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/project/assets.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::app {

using arm::ArmModel;
using arm::JointKind;
using arm::JointPositions;

void add_arm_option(CLI::App& command, std::string& arm) {
    command.add_option("--arm", arm, "Shipped arm or arm file")
        ->type_name("NAME|FILE")
        ->capture_default_str();
}

arm::ArmFile arm_file_of(const std::string& name) {
    return arm::read_arm(project::arm_path(name, ".", project::assets_folder()));
}

ArmModel arm_of(const std::string& name) {
    return arm_file_of(name).arm;
}

double to_joint(const ArmModel& arm, int joint, double shown) {
    return arm.joint(joint).kind == JointKind::revolute ? from_degrees(shown) : shown;
}

double from_joint(const ArmModel& arm, int joint, double position) {
    return arm.joint(joint).kind == JointKind::revolute ? to_degrees(position) : position;
}

JointPositions given_joints(const ArmModel& arm, const std::vector<double>& shown) {
    if (static_cast<int>(shown.size()) != arm.joint_count()) {
        throw Error(fmt::format("{} has {}, but {} positions were given",
                                arm.name(),
                                counted(arm.joint_count(), "joint"),
                                shown.size()));
    }
    JointPositions q(arm.joint_count());
    for (int n = 0; n < arm.joint_count(); ++n) {
        q[n] = to_joint(arm, n, shown[static_cast<std::size_t>(n)]);
        if (!std::isfinite(q[n])) {
            throw Error(fmt::format("joint {}: the position is not a finite number", arm.joint(n).name));
        }
    }
    return q;
}

double rounded(double value) {
    return std::round(value * 1e9) / 1e9 + 0.0;
}

JointPositions resting(const ArmModel& arm) {
    JointPositions q = JointPositions::Zero(arm.joint_count());
    for (int n = 0; n < arm.joint_count(); ++n) {
        q[n] = std::clamp(0.0, arm.joint(n).min, arm.joint(n).max);
    }
    return q;
}

} // namespace millwright::app
