#include "core/simulation/collision_motion.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::simulation {

namespace {

using kinematics::MachineModel;

/// Parts of a move turn so little that the bound on the acceleration holds and is close.
constexpr double turn_of_a_part = 0.5; // rad, all rotary axes together

std::vector<int> chain_to(const MachineModel& machine, char letter) {
    if (letter == '\0') {
        return {};
    }
    for (const auto* chain : {&machine.table_chain(), &machine.head_chain()}) {
        const auto found = std::find_if(
            chain->begin(), chain->end(), [&](int n) { return machine.axis(n).letter == letter; });
        if (found != chain->end()) {
            return {chain->begin(), found + 1};
        }
    }
    throw Defect("a body is carried by an axis of the machine");
}

} // namespace

char tool_carrier(const MachineModel& machine) {
    return machine.head_chain().empty() ? '\0' : machine.axis(machine.head_chain().back()).letter;
}

char work_carrier(const MachineModel& machine) {
    return machine.table_chain().empty() ? '\0' : machine.axis(machine.table_chain().back()).letter;
}

RelativeMotion::RelativeMotion(const MachineModel& machine,
                               const kinematics::AxisPositions& from,
                               const kinematics::AxisPositions& to,
                               char moving,
                               char still) {
    const std::vector<int> outwards = chain_to(machine, moving);
    const std::vector<int> inwards = chain_to(machine, still);
    // What carries both moves neither against the other.
    const auto shared = static_cast<std::size_t>(
        std::mismatch(outwards.begin(), outwards.end(), inwards.begin(), inwards.end()).first -
        outwards.begin());
    const auto add_axis = [&](int n, double sense) {
        const kinematics::MachineAxis& axis = machine.axis(n);
        add(axis, from[n] + axis.zero_offset, to[n] - from[n], sense);
    };
    for (std::size_t n = inwards.size(); n > shared; --n) {
        add_axis(inwards[n - 1], -1.0);
    }
    for (std::size_t n = shared; n < outwards.size(); ++n) {
        add_axis(outwards[n], 1.0);
    }
    double turn = 0.0;
    for (std::size_t n = 0; n < count_; ++n) {
        turn += joints_.at(n).rotary ? std::abs(joints_.at(n).way) : 0.0;
        rests_ = rests_ && !(std::abs(joints_.at(n).way) > 0.0);
    }
    constexpr double most_parts = 1e6;
    parts_ = static_cast<int>(std::clamp(std::ceil(turn / turn_of_a_part), 1.0, most_parts));
}

void RelativeMotion::add(const kinematics::MachineAxis& axis, double begin, double way, double sense) {
    joints_.at(count_++) = {
        axis.kind == kinematics::AxisKind::rotary, axis.direction, axis.point, sense * begin, sense * way};
}

Frame RelativeMotion::moved_by(const Joint& joint, double amount) {
    Frame motion = Frame::Identity();
    if (joint.rotary) {
        motion.linear() = Eigen::AngleAxisd(amount, joint.direction).toRotationMatrix();
        motion.translation() = joint.point - motion.linear() * joint.point;
    } else {
        motion.translation() = amount * joint.direction;
    }
    return motion;
}

Frame RelativeMotion::at(double t) const {
    Frame pose = Frame::Identity();
    for (std::size_t n = 0; n < count_; ++n) {
        pose = pose * moved_by(joints_[n], joints_[n].begin + t * joints_[n].way);
    }
    return pose;
}

double RelativeMotion::reach(double t, double half, const BodyBall& body) const {
    std::array<Frame, most_joints + 1> pose; // before each joint
    pose[0] = Frame::Identity();
    for (std::size_t n = 0; n < count_; ++n) {
        pose.at(n + 1) = pose.at(n) * moved_by(joints_[n], joints_[n].begin + t * joints_[n].way);
    }
    const Vec3 center = pose.at(count_) * body.center;
    Vec3 speed = Vec3::Zero(), turn = Vec3::Zero();
    double turns = 0.0;  // of all rotary joints, each without sign
    double speeds = 0.0; // the same of the farthest point
    for (std::size_t n = 0; n < count_; ++n) {
        const Joint& joint = joints_[n];
        const Vec3 direction = pose.at(n).linear() * joint.direction;
        if (!joint.rotary) {
            speed += joint.way * direction;
            speeds += std::abs(joint.way);
            continue;
        }
        const Vec3 arm = center - pose.at(n) * joint.point;
        turn += joint.way * direction;
        speed += joint.way * direction.cross(arm);
        turns += std::abs(joint.way);
        speeds += std::abs(joint.way) * (direction.cross(arm).norm() + body.radius);
    }
    if (body.axis) {
        const Vec3 axis = pose.at(count_).linear() * *body.axis;
        turn -= turn.dot(axis) * axis;
    }
    // d^2p/dt^2 = sum_i w_i x (v_i + 2 sum over joints k beyond i of v_k), so at most 2 (sum |w|) (sum |v|).
    // While the point moves by at most (sum |v|) h, its arms grow by that.
    const double grown = 1.0 - std::min(turns * half, 0.5);
    const double bend = 2.0 * turns * speeds / grown;
    return (speed.norm() + turn.norm() * body.radius) * half + 0.5 * bend * half * half;
}

} // namespace millwright::simulation
