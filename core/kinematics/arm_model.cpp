#include "core/kinematics/arm_model.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::kinematics {

namespace {

constexpr std::size_t most_joints = 9;

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
    if (!same(arm.tool_tip.x(), 0.0) || !same(arm.tool_tip.y(), 0.0)) {
        return std::nullopt;
    }
    return PlanarElbow{arm.joints[2].a, arm.joints[3].a, arm.tool_tip.z()};
}

} // namespace

ArmModel::ArmModel(ArmDescription description) : description_(std::move(description)) {
    const auto& joints = description_.joints;
    if (joints.empty() || joints.size() > most_joints) {
        throw Error(fmt::format("an arm has 1 to {} joints, not {}", most_joints, joints.size()));
    }
    const auto faulty = std::ranges::find_if_not(joints, is_sound);
    if (faulty != joints.end()) {
        throw Error(
            fmt::format("joint '{}' needs finite parameters, positive rates and min < max", faulty->name));
    }
    if (!is_finite(description_.tool_tip)) {
        throw Error("the tool's tip is a finite point");
    }
    planar_elbow_ = planar_elbow_of(description_);
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

} // namespace millwright::kinematics
