#include "core/motion/arm_motion.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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

using arm::ArmModel;
using arm::JointPositions;

namespace {

void go_straight(ArmMotion& motion, const ArmModel& arm, const ArmStop& stop) {
    constexpr double quarter_turn = 0.5 * pi;
    const std::vector<arm::ArmWay> ways{straight_way(arm::base_T_tool(arm, motion.joints()),
                                                     arm::base_T_tool(arm, stop.joints),
                                                     stop.share * taught_motion_speed)};
    arm::ArmPathSettings settings;
    settings.aim = arm::aim_of(arm, quarter_turn);
    motion.follow(ways, arm::follow_path(arm, ways, motion.joints(), settings, {}), {});
    const double turn = (motion.joints() - stop.joints).cwiseAbs().maxCoeff();
    constexpr double same_branch = 0.01; // rad or mm
    if (turn > same_branch) {
        throw Error(
            "a straight line leads there with the arm in another configuration", {}, "use a joint move");
    }
}

} // namespace

double joint_time(const ArmModel& arm, const JointPositions& way, double share) {
    expects(share > 0.0 && share <= 1.0, "a share of the speed is above 0 and at most 1");
    double longest = 0.0;
    for (int n = 0; n < arm.joint_count(); ++n) {
        longest = std::max(longest, std::abs(way[n]) / (share * arm.joint(n).max_velocity));
    }
    return longest;
}

arm::ArmWay straight_way(const Frame& from, const Frame& to, double speed) {
    const Eigen::Quaterniond first(from.linear()), last(to.linear());
    const Vec3 begin = from.translation(), end = to.translation();
    const double length = (end - begin).norm();
    const auto at = [=](double share) {
        Frame frame = Frame::Identity();
        frame.translation() = begin + share * (end - begin);
        frame.linear() = first.slerp(share, last).toRotationMatrix();
        return frame;
    };
    return {at, length, speed > 0.0 ? length / speed : 0.0, 0};
}

program::Program
motion_through(const ArmModel& arm, const JointPositions& start, const std::vector<ArmStop>& stops) {
    ArmMotion motion(arm, start);
    for (const ArmStop& stop : stops) {
        expects(stop.share > 0.0 && stop.share <= 1.0, "the speed share of a stop is above 0 and at most 1");
        try {
            if (stop.joints.size() != arm.joint_count()) {
                throw Error(fmt::format("it was taught on an arm with {} joints", stop.joints.size()));
            }
            if (stop.straight) {
                go_straight(motion, arm, stop);
            } else {
                motion.go_to(stop.joints, joint_time(arm, stop.joints - motion.joints(), stop.share));
            }
        } catch (const Error& error) {
            const Diagnostic& found = error.diagnostic();
            throw Error(fmt::format("'{}' cannot be reached: {}", stop.name, found.message), {}, found.hint);
        }
    }
    return motion.program();
}

} // namespace millwright::motion
