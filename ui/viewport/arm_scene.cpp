#include "ui/viewport/arm_scene.h"

#include "core/arm/arm_forward.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::viewport {

namespace {

constexpr double near_angle = 10.0 * pi / 180.0;
constexpr double near_share = 0.05; // of the range of a sliding joint

bool same_pose(const arm::JointPositions& a, const arm::JointPositions& b) {
    return a.size() == b.size() && a == b;
}

bool same_pose(const std::optional<arm::JointPositions>& a, const std::optional<arm::JointPositions>& b) {
    return a && b ? same_pose(*a, *b) : a.has_value() == b.has_value();
}

bool same_pose(const std::optional<Frame>& a, const std::optional<Frame>& b) {
    return a && b ? a->matrix() == b->matrix() : a.has_value() == b.has_value();
}

double lowest_of(const std::vector<geometry::SolidBody>& bodies, const std::vector<arm::ArmPart>& parts) {
    double lowest = 0.0;
    for (std::size_t n = 0; n < bodies.size(); ++n) {
        if (parts[n].carrier == arm::ArmCarrier::base) {
            for (const geometry::SolidMesh& mesh : bodies[n].meshes) {
                for (const Vec3& point : mesh.positions) {
                    lowest = std::min(lowest, point.z());
                }
            }
        }
    }
    return lowest;
}

} // namespace

std::shared_ptr<const ArmLook> read_arm_look(const std::filesystem::path& file) {
    arm::ArmFile read = arm::read_arm(file);
    std::vector<geometry::SolidBody> bodies;
    double foot = 0.0;
    if (read.bodies) {
        bodies = arm::read_bodies(*read.bodies);
        foot = lowest_of(bodies, read.bodies->parts);
    }
    auto shell =
        read.arm.planar_elbow() ? std::optional(arm::reach_shell(read.arm)) : arm::sampled_shell(read.arm);
    const double reach = arm::stretched_length(read.arm);
    return std::make_shared<const ArmLook>(
        ArmLook{std::move(read), std::move(bodies), std::move(shell), reach, foot});
}

bool operator==(const ArmScene& a, const ArmScene& b) {
    return a.look == b.look && same_pose(a.joints, b.joints) && same_pose(a.ghost, b.ghost) &&
           a.trace == b.trace && a.track == b.track && same_pose(a.part, b.part);
}

double share_of_range(const arm::ArmJoint& joint, double position) {
    const double range = joint.max - joint.min;
    return std::isfinite(range) ? std::clamp((position - joint.min) / range, 0.0, 1.0) : 0.5;
}

bool near_limit(const arm::ArmJoint& joint, double position) {
    const double near =
        joint.kind == arm::JointKind::revolute ? near_angle : near_share * (joint.max - joint.min);
    return position < joint.min + near || position > joint.max - near;
}

} // namespace millwright::viewport
