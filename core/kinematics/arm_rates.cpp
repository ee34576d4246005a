#include "core/kinematics/arm_rates.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/arm_forward.h"
#include "core/kinematics/arm_hold.h"
#include "core/kinematics/arm_inverse.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::kinematics {

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

ArmRates tip_rates(const ArmModel& arm, const JointPositions& joints, const Vec3& velocity) {
    const double speed = velocity.norm();
    expects(std::isfinite(speed) && speed > 0.0, "a velocity has a direction");
    const Vec3 tip = base_T_tool(arm, joints).translation();
    const Frame goal = carried_tool(arm, joints, tip + ahead_mm / speed * velocity);
    const ArmDemand demand = arm.joint_count() > 5 ? ArmDemand::frame : ArmDemand::tip_and_axis;
    const ArmHold hold = hold_tool(arm, goal, {demand, 0.5 * pi}, joints);
    if (hold.trouble != ArmTrouble::none) {
        return {std::nullopt, hold.why};
    }
    const double step = joint_step(arm, hold.joints, joints);
    if (!(step < most_turn)) {
        return {std::nullopt,
                fmt::format("so near to a singular place a joint would turn {:.1f} deg in {} mm",
                            to_degrees(step),
                            ahead_mm)};
    }
    return {JointPositions((hold.joints - joints) * (speed / ahead_mm)), {}};
}

} // namespace millwright::kinematics
