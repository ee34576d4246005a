#include "core/arm/arm_model.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::arm {

namespace {

bool is_sound(const ArmJoint& joint) {
    return std::isfinite(joint.alpha) && std::isfinite(joint.a) && std::isfinite(joint.d) &&
           std::isfinite(joint.theta) && joint.min < joint.max && joint.max_velocity > 0.0 &&
           joint.max_acceleration > 0.0 && std::isfinite(joint.max_velocity) &&
           std::isfinite(joint.max_acceleration);
}

bool same(double a, double b) {
    constexpr double rounding = 1e-12; // of degrees turned into radians
    return std::abs(a - b) < rounding;
}

std::optional<PlanarElbow> planar_elbow_of(const ArmDescription& arm) {
    constexpr std::array<double, 5> twists{0.0, -0.5 * pi, 0.0, 0.0, 0.5 * pi};
    if (arm.joints.size() != twists.size()) {
        return std::nullopt;
    }
    for (std::size_t n = 0; n < twists.size(); ++n) {
        const ArmJoint& joint = arm.joints[n];
        const bool has_length = n == 2 || n == 3;
        if (joint.kind != JointKind::revolute || !same(joint.alpha, twists[n]) || !same(joint.d, 0.0) ||
            (has_length ? joint.a <= 0.0 : !same(joint.a, 0.0))) {
            return std::nullopt;
        }
    }
    if (!same(arm.tool_tip.x(), 0.0) || !same(arm.tool_tip.y(), 0.0) || !same(arm.end_alpha, 0.0) ||
        !same(arm.end_a, 0.0)) {
        return std::nullopt;
    }
    return PlanarElbow{arm.joints[2].a, arm.joints[3].a, arm.tool_tip.z()};
}

JointPositions default_home(const ArmDescription& arm, bool like_l3) {
    if (like_l3) {
        return arm_home();
    }
    JointPositions home(static_cast<Eigen::Index>(arm.joints.size()));
    std::ranges::transform(arm.joints, home.begin(), [](const ArmJoint& joint) {
        return std::clamp(0.0, joint.min, joint.max);
    });
    return home;
}

} // namespace

JointPositions arm_home() {
    JointPositions home(5);
    home << 0.0, -0.5 * pi, 0.5 * pi, 0.0, 0.0;
    return home;
}

ArmDescription from_classical(ArmDescription table) {
    table.end_alpha = table.end_a = 0.0;
    for (ArmJoint& joint : table.joints) {
        std::swap(joint.alpha, table.end_alpha);
        std::swap(joint.a, table.end_a);
    }
    return table;
}

ArmModel::ArmModel(ArmDescription description) : description_(std::move(description)) {
    const auto& joints = description_.joints;
    if (joints.empty() || joints.size() > most_arm_joints) {
        throw Error(fmt::format("an arm must have 1 to {} joints, not {}", most_arm_joints, joints.size()));
    }
    const auto faulty = std::ranges::find_if_not(joints, is_sound);
    if (faulty != joints.end()) {
        throw Error(
            fmt::format("joint '{}' needs finite parameters, positive rates and min < max", faulty->name));
    }
    if (!is_finite(description_.tool_tip) || !std::isfinite(description_.end_alpha) ||
        !std::isfinite(description_.end_a)) {
        throw Error("the last link and the tool tip must be finite");
    }
    planar_elbow_ = planar_elbow_of(description_);
    if (description_.home.size() == 0) {
        description_.home = default_home(description_, planar_elbow_.has_value());
        return;
    }
    if (description_.home.size() != joint_count()) {
        throw Error(fmt::format(
            "the home has {} positions, but the arm has {} joints", description_.home.size(), joint_count()));
    }
    if (const int outside = joint_outside(description_.home); outside >= 0) {
        throw Error(fmt::format("the home is outside the limits of joint {}", joint(outside).name));
    }
}

int ArmModel::joint_outside(const JointPositions& positions) const {
    expects(positions.size() == joint_count(), "a position for every joint");
    for (int n = 0; n < joint_count(); ++n) {
        if (!(positions[n] >= joint(n).min && positions[n] <= joint(n).max)) {
            return n;
        }
    }
    return -1;
}

JointExcess ArmModel::farthest_outside(const JointPositions& positions) const {
    expects(positions.size() == joint_count(), "a position for every joint");
    JointExcess found;
    double largest = 0.0;
    for (int n = 0; n < joint_count(); ++n) {
        const double beyond = std::max(joint(n).min - positions[n], positions[n] - joint(n).max);
        const double share = beyond / (joint(n).max - joint(n).min);
        if (beyond > 0.0 && (found.joint < 0 || share > largest)) {
            found = {n, beyond};
            largest = share;
        }
    }
    return found;
}

} // namespace millwright::arm
