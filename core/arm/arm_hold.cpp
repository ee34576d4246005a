#include "core/arm/arm_hold.h"

#include "core/arm/arm_forward.h"
#include "core/arm/arm_inverse.h"
#include "core/arm/arm_zone.h"
#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::arm {

namespace {

constexpr int starting_points = 100;    // for arms without a closed form
constexpr double kept_direction = 1e-3; // rad: rounding of a search that ends at a minimum

ArmTrouble trouble_of(kinematics::Reach reach) {
    return reach == kinematics::Reach::outside_limits ? ArmTrouble::joint_limit : ArmTrouble::out_of_reach;
}

/// The goal as an arm of five joints can have it.
struct Turned {
    Frame goal;
    double tilt = 0.0;
};

std::optional<Turned> into_the_plane(const Frame& goal, const ArmAim& aim) {
    const std::optional<Frame> projected = projected_goal(goal);
    if (!projected) {
        return std::nullopt;
    }
    const double tilt = angle_between(projected->linear().col(2), goal.linear().col(2));
    const bool allowed = aim.demand == ArmDemand::tip || tilt <= aim.most_tilt;
    return allowed ? std::optional(Turned{*projected, tilt}) : std::nullopt;
}

ArmInverseSolution
in_closed_form(const ArmModel& arm, const Frame& goal, ArmDemand demand, const JointPositions& previous) {
    return demand == ArmDemand::frame
               ? arm_inverse(arm, goal, previous)
               : arm_inverse(arm, PointedGoal{goal.translation(), goal.linear().col(2)}, previous);
}

/// Takes those away that leave the arm's zone; how the one does that leaves it least.
std::optional<ZoneBreach>
keep_zone(const ArmModel& arm, const JointPositions& previous, std::vector<JointPositions>& ways) {
    std::optional<ZoneBreach> least;
    std::erase_if(ways, [&](const JointPositions& q) {
        std::optional<ZoneBreach> exit = zone_exit(arm, previous, q);
        const bool leaves = exit.has_value();
        if (leaves && (!least || exit->depth < least->depth)) {
            least = std::move(exit);
        }
        return leaves;
    });
    return least;
}

ArmHold not_held(const JointPositions& previous, ArmTrouble trouble, std::string why, ArmShortfall off) {
    return {previous, trouble, std::move(why), 0.0, off};
}

ArmHold outside_zone(const JointPositions& previous, const ZoneBreach& exit) {
    return not_held(previous, ArmTrouble::joint_limit, exit.why, {.tip = exit.of_tip ? exit.depth : 0.0});
}

/// Of the tool axis out of the plane of an arm with five joints, rad.
double out_of_plane(const Frame& goal) {
    const Vec3 tip = goal.translation();
    const Vec3 across = Vec3(-tip.y(), tip.x(), 0.0).normalized();
    return std::abs(std::asin(std::clamp(across.dot(goal.linear().col(2)), -1.0, 1.0)));
}

ArmHold
by_branches(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    const std::optional<Turned> turned = into_the_plane(goal, aim);
    if (!turned) {
        const double out = out_of_plane(goal);
        return not_held(
            previous,
            ArmTrouble::tool_axis,
            fmt::format("the tool axis is {:.3f} deg out of the plane of the arm, which has only five joints",
                        to_degrees(out)),
            {.axis = out});
    }
    ArmInverseSolution found = in_closed_form(arm, turned->goal, aim.demand, previous);
    if (found.branches.empty()) {
        return not_held(previous,
                        trouble_of(found.reach),
                        found.why,
                        {.tip = found.beyond_reach, .axis = found.out_of_plane, .joint = found.excess});
    }
    if (const auto exit = keep_zone(arm, previous, found.branches); found.branches.empty()) {
        return outside_zone(previous, *exit);
    }
    const auto away = [&](const JointPositions& q) { return joint_step(arm, q, previous); };
    return {*std::ranges::min_element(found.branches, {}, away), ArmTrouble::none, {}, turned->tilt, {}};
}

ArmHold kept_in_zone(const ArmModel& arm, const JointPositions& previous, JointPositions found, double tilt) {
    if (const auto exit = zone_exit(arm, previous, found)) {
        return outside_zone(previous, *exit);
    }
    return {std::move(found), ArmTrouble::none, {}, tilt, {}};
}

ArmSolverSettings weighing(double angles) {
    ArmSolverSettings settings;
    settings.angle_weight = angles;
    return settings;
}

/// From `start`, or, where that leads nowhere, from joints that are bent a little: out of a stretched arm no
/// small motion leads inwards.
ArmSolverResult solve_beside(const ArmModel& arm,
                             const Frame& goal,
                             ArmDemand demand,
                             const JointPositions& start,
                             const ArmSolverSettings& settings = {}) {
    constexpr double little = 0.1; // rad
    ArmSolverResult found = solve_arm(arm, goal, demand, start, settings);
    if (found.converged) {
        return found;
    }
    JointPositions bent = start;
    for (int n = 0; n < arm.joint_count(); ++n) {
        const bool turns = arm.joint(n).kind == JointKind::revolute;
        bent[n] += !turns ? 0.0 : n % 2 == 0 ? little : -little;
    }
    ArmSolverResult other = solve_arm(arm, goal, demand, bent, settings);
    const double length = std::max(stretched_length(arm), 1.0);
    const auto miss = [&](const ArmSolverResult& result) {
        return std::hypot(result.tip_error / length, settings.angle_weight * result.angle_error);
    };
    return other.converged || miss(other) < miss(found) ? other : found;
}

/// The tip in its place and the tool turned as little as it is found to need; nothing if the tip is out of
/// reach.
std::optional<ArmSolverResult>
least_turned(const ArmModel& arm, const Frame& goal, ArmDemand demand, const JointPositions& start) {
    const ArmSolverResult near = solve_beside(arm, goal, demand, start, weighing(0.01));
    ArmSolverResult found = solve_beside(arm, goal, ArmDemand::tip, near.positions);
    if (!found.converged) {
        return std::nullopt;
    }
    const Mat3 is = base_T_tool(arm, found.positions).linear(), should = goal.linear();
    found.angle_error = demand == ArmDemand::frame ? Eigen::AngleAxisd(Mat3(is.transpose() * should)).angle()
                                                   : angle_between(is.col(2), should.col(2));
    return found;
}

ArmModel without_limits(const ArmModel& arm) {
    ArmDescription description = arm.description();
    for (ArmJoint& joint : description.joints) {
        joint.min = -std::numeric_limits<double>::infinity();
        joint.max = std::numeric_limits<double>::infinity();
    }
    return ArmModel(std::move(description));
}

/// Each joint that turns in the turn nearest to its limits.
JointPositions in_nearest_turns(const ArmModel& arm, JointPositions positions) {
    constexpr double turn = 2.0 * pi;
    for (int n = 0; n < arm.joint_count(); ++n) {
        const ArmJoint& joint = arm.joint(n);
        if (joint.kind == JointKind::revolute) {
            const double inside = std::clamp(positions[n], joint.min, joint.max);
            const double near = positions[n] + turn * std::round((inside - positions[n]) / turn);
            const double over = near > joint.max ? near - turn : near < joint.min ? near + turn : near;
            positions[n] = over >= joint.min && over <= joint.max ? over : near;
        }
    }
    return positions;
}

ArmHold at_a_limit(const ArmModel& arm, const JointPositions& previous, const JointPositions& found) {
    const JointExcess excess = arm.farthest_outside(found);
    const ArmJoint& joint = arm.joint(excess.joint);
    const bool turns = joint.kind == JointKind::revolute;
    const auto shown = [&](double value) { return turns ? to_degrees(value) : value; };
    return not_held(previous,
                    ArmTrouble::joint_limit,
                    fmt::format("joint {} would have to move to {:.3f} {}, outside {:.3f} to {:.3f}",
                                joint.name,
                                shown(found[excess.joint]),
                                turns ? "deg" : "mm",
                                shown(joint.min),
                                shown(joint.max)),
                    {.joint = excess});
}

/// Farther from the base than the arm is long, all its links in one line.
bool is_too_far(const ArmModel& arm, const Frame& goal) {
    constexpr double rounding_mm = 1e-6;
    const bool endless = std::ranges::any_of(arm.description().joints, [](const ArmJoint& joint) {
        return joint.kind == JointKind::prismatic && !(std::isfinite(joint.min) && std::isfinite(joint.max));
    });
    return !endless && goal.translation().norm() > stretched_length(arm) + rounding_mm;
}

ArmHold out_of_reach(const JointPositions& previous, const ArmSolverResult& nearest) {
    const double angle = nearest.angle_error > kept_direction ? nearest.angle_error : 0.0;
    return not_held(
        previous,
        ArmTrouble::out_of_reach,
        fmt::format("no joint position was found; the nearest one is off by {:.3f} mm and {:.3f} deg",
                    nearest.tip_error,
                    to_degrees(angle)),
        {.tip = nearest.tip_error, .axis = angle});
}

/// What keeps an arm without a closed form from a goal that no solution was found for: limits of joints, the
/// direction of the tool, or its reach. `nearest`: where the search ended; `turned`: with the tip alone in
/// its place, if that is possible.
ArmHold explained(const ArmModel& arm,
                  const Frame& goal,
                  const ArmAim& aim,
                  const JointPositions& previous,
                  const JointPositions& nearest,
                  const std::optional<ArmSolverResult>& turned) {
    const ArmSolverResult directed = solve_beside(arm, goal, aim.demand, nearest, weighing(100.0));
    if (is_too_far(arm, goal)) {
        return out_of_reach(previous, directed);
    }
    const ArmSolverResult free = solve_beside(without_limits(arm), goal, aim.demand, previous);
    if (free.converged) {
        const JointPositions found = in_nearest_turns(arm, free.positions);
        return arm.joint_outside(found) < 0 ? kept_in_zone(arm, previous, found, 0.0)
                                            : at_a_limit(arm, previous, found);
    }
    if (turned && directed.angle_error > kept_direction) {
        return not_held(previous,
                        ArmTrouble::tool_axis,
                        fmt::format("the tip can reach the point, but not with this tool direction: the "
                                    "nearest direction found is {:.3f} deg off",
                                    to_degrees(turned->angle_error)),
                        {.axis = turned->angle_error});
    }
    return out_of_reach(previous, directed);
}

ArmHold by_search(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    const ArmSolverResult found = solve_beside(arm, goal, aim.demand, previous);
    if (found.converged) {
        return kept_in_zone(arm, previous, found.positions, 0.0);
    }
    std::optional<ArmSolverResult> turned;
    if (aim.demand != ArmDemand::tip && !is_too_far(arm, goal)) {
        turned = least_turned(arm, goal, aim.demand, previous);
    }
    if (turned && aim.demand == ArmDemand::tip_and_axis && turned->angle_error <= aim.most_tilt) {
        return kept_in_zone(arm, previous, turned->positions, turned->angle_error);
    }
    return explained(arm, goal, aim, previous, found.positions, turned);
}

} // namespace

ArmAim aim_of(const ArmModel& arm, double most_tilt) {
    constexpr int free_roll = 5;
    return {arm.joint_count() <= free_roll ? ArmDemand::tip_and_axis : ArmDemand::frame, most_tilt};
}

double joint_step(const ArmModel& arm, const JointPositions& a, const JointPositions& b) {
    double largest = 0.0;
    for (int n = 0; n < arm.joint_count(); ++n) {
        const bool slides = arm.joint(n).kind == JointKind::prismatic;
        const double unit = slides ? std::max(stretched_length(arm), 1.0) : 1.0;
        largest = std::max(largest, std::abs(a[n] - b[n]) / unit);
    }
    return largest;
}

ArmHold hold_tool(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    return arm.planar_elbow() ? by_branches(arm, goal, aim, previous) : by_search(arm, goal, aim, previous);
}

std::vector<JointPositions>
all_holds(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    if (!arm.planar_elbow()) {
        auto found = solve_arm_from_many_starts(arm, goal, aim.demand, previous, starting_points);
        (void)keep_zone(arm, previous, found);
        return found;
    }
    const std::optional<Turned> turned = into_the_plane(goal, aim);
    if (!turned) {
        return {};
    }
    auto branches = in_closed_form(arm, turned->goal, aim.demand, previous).branches;
    (void)keep_zone(arm, previous, branches);
    std::ranges::stable_sort(
        branches, {}, [&](const JointPositions& q) { return joint_step(arm, q, previous); });
    return branches;
}

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
