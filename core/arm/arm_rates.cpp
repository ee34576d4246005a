#include "core/arm/arm_rates.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::arm {

namespace {

constexpr double ahead_mm = 0.5;   // that the inverse is asked ahead
constexpr double most_turn = 0.05; // rad that a joint may turn in that way; more is next to singular

} // namespace

Frame carried_tool(const ArmModel& arm, const JointPositions& joints, const Vec3& tip) {
    Frame goal = base_T_tool(arm, joints);
    const Vec3 from = goal.translation();
    const bool on_axis = std::hypot(from.x(), from.y()) < base_axis_tolerance ||
                         std::hypot(tip.x(), tip.y()) < base_axis_tolerance;
    if (arm.planar_elbow() && !on_axis) {
        const double turn = std::atan2(tip.y(), tip.x()) - std::atan2(from.y(), from.x());
        goal.linear() = (Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix() * goal.linear()).eval();
    }
    goal.translation() = tip;
    return goal;
}

ArmHold moved_tip(const ArmModel& arm, const JointPositions& joints, const Vec3& way) {
    const double length = way.norm();
    const Vec3 tip = base_T_tool(arm, joints).translation();
    const ArmDemand demand = arm.joint_count() > 5 ? ArmDemand::frame : ArmDemand::tip_and_axis;
    const ArmHold hold = hold_tool(arm, carried_tool(arm, joints, tip + way), {demand, 0.5 * pi}, joints);
    const double turn = joint_step(arm, hold.joints, joints);
    if (hold.trouble != ArmTrouble::none || turn < most_turn * std::max(1.0, length / ahead_mm)) {
        return hold;
    }
    return {joints,
            ArmTrouble::jump,
            fmt::format("so close to a singularity, a joint would turn {:.1f} deg in {:.3g} mm",
                        to_degrees(turn),
                        length),
            0.0};
}

ArmRates tip_rates(const ArmModel& arm, const JointPositions& joints, const Vec3& velocity) {
    const double speed = velocity.norm();
    expects(std::isfinite(speed) && speed > 0.0, "a velocity has a direction");
    const ArmHold hold = moved_tip(arm, joints, ahead_mm / speed * velocity);
    if (hold.trouble != ArmTrouble::none) {
        return {std::nullopt, hold.why};
    }
    return {JointPositions((hold.joints - joints) * (speed / ahead_mm)), {}};
}

} // namespace millwright::arm
