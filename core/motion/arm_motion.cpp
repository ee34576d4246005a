#include "core/motion/arm_motion.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

namespace millwright::motion {

using arm::ArmJoint;
using arm::ArmPathPoint;
using arm::ArmTrouble;
using arm::ArmWay;
using arm::JointPositions;
using program::BlockKind;

namespace {

constexpr double rounding = 1e-9; // rad: joints that are the same

void expect_inside(const arm::ArmModel& arm, const JointPositions& joints) {
    expects(joints.size() == arm.joint_count() && joints.allFinite(), "a finite position for every joint");
    const int n = arm.joint_outside(joints);
    if (n < 0) {
        return;
    }
    const ArmJoint& joint = arm.joint(n);
    const bool turns = joint.kind == arm::JointKind::revolute;
    const auto shown = [&](double value) { return turns ? to_degrees(value) : value; };
    throw Error(fmt::format("joint {} would have to move to {:.3f} {}, but its limits are {:.3f} and {:.3f}",
                            joint.name,
                            shown(joints[n]),
                            turns ? "deg" : "mm",
                            shown(joint.min),
                            shown(joint.max)));
}

[[noreturn]] void
refuse(const std::vector<ArmWay>& ways, const arm::ArmPath& path, const std::filesystem::path& file) {
    const arm::ArmFinding& finding = path.findings.front();
    const int line = ways[static_cast<std::size_t>(path.points[finding.first].way)].line;
    throw Error(Diagnostic{.place = {.file = file, .line = line}, .message = finding.why, .hint = {}});
}

} // namespace

ArmMotion::ArmMotion(const arm::ArmModel& arm, const JointPositions& start) : arm_(arm) {
    expect_inside(arm, start);
    program_.machine = arm.name();
    program_.start = start;
    for (const ArmJoint& joint : arm.description().joints) {
        const bool turns = joint.kind == arm::JointKind::revolute;
        program_.axes.push_back({static_cast<char>('1' + program_.axes.size()),
                                 turns ? kinematics::AxisKind::rotary : kinematics::AxisKind::linear});
    }
}

const JointPositions& ArmMotion::joints() const {
    return program_.blocks.empty() ? program_.start : program_.blocks.back().target;
}

void ArmMotion::add(BlockKind kind, const JointPositions& target, double seconds, int line) {
    program::Block block;
    block.kind = kind;
    block.target = target;
    block.named = program::AxisSet::all(arm_.joint_count());
    block.duration = seconds;
    block.source_line = line;
    block.path = program::PathControl{program::PathMode::continuous, 0.0};
    program_.blocks.push_back(std::move(block));
}

void ArmMotion::go_to(const JointPositions& target, double seconds) {
    expect_inside(arm_, target);
    add(seconds > 0.0 ? BlockKind::feed : BlockKind::rapid, target, seconds, 0);
}

void ArmMotion::follow(const std::vector<ArmWay>& ways,
                       const arm::ArmPath& path,
                       const std::filesystem::path& file) {
    if (!path.whole()) {
        refuse(ways, path, file);
    }
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        const ArmPathPoint& point = path.points[n];
        const ArmWay& way = ways[static_cast<std::size_t>(point.way)];
        const bool first = n == 0 || path.points[n - 1].way != point.way;
        if (first) {
            if (arm::joint_step(arm_, point.joints, joints()) > rounding) {
                go_to(point.joints);
            }
            continue;
        }
        const double seconds = (point.share - path.points[n - 1].share) * way.duration;
        add(seconds > 0.0 ? BlockKind::feed : BlockKind::rapid, point.joints, seconds, way.line);
    }
}

} // namespace millwright::motion
