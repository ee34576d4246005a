#include "core/motion/taught_points_motion.h"

#include "core/arm/arm_forward.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::motion {

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
