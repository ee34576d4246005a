#include "core/kinematics/arm_hold.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/kinematics/arm_forward.h"
#include "core/kinematics/arm_inverse.h"
#include "core/kinematics/arm_zone.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::kinematics {

namespace {

constexpr int starting_points = 100; // for arms without a closed form

ArmTrouble trouble_of(Reach reach) {
    return reach == Reach::outside_limits ? ArmTrouble::joint_limit : ArmTrouble::out_of_reach;
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

InverseSolution
in_closed_form(const ArmModel& arm, const Frame& goal, ArmDemand demand, const JointPositions& previous) {
    return demand == ArmDemand::frame
               ? arm_inverse(arm, goal, previous)
               : arm_inverse(arm, PointedGoal{goal.translation(), goal.linear().col(2)}, previous);
}

/// Takes those away that leave the arm's zone; why the last of them does.
std::string
keep_zone(const ArmModel& arm, const JointPositions& previous, std::vector<JointPositions>& ways) {
    std::string why;
    std::erase_if(ways, [&](const JointPositions& q) {
        std::string reason = leaves_zone(arm, previous, q);
        const bool leaves = !reason.empty();
        why = leaves ? std::move(reason) : why;
        return leaves;
    });
    return why;
}

std::string tilt_sentence(const Frame& goal) {
    const Vec3 tip = goal.translation();
    const Vec3 across = Vec3(-tip.y(), tip.x(), 0.0).normalized();
    const double out = std::asin(std::clamp(across.dot(goal.linear().col(2)), -1.0, 1.0));
    return fmt::format("the tool axis is {:.3f} deg out of the plane of the arm, which has five joints only",
                       std::abs(to_degrees(out)));
}

ArmHold
by_branches(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    const std::optional<Turned> turned = into_the_plane(goal, aim);
    if (!turned) {
        return {previous, ArmTrouble::tool_axis, tilt_sentence(goal), 0.0};
    }
    InverseSolution found = in_closed_form(arm, turned->goal, aim.demand, previous);
    if (found.branches.empty()) {
        return {previous, trouble_of(found.reach), found.why, 0.0};
    }
    if (std::string why = keep_zone(arm, previous, found.branches); found.branches.empty()) {
        return {previous, ArmTrouble::joint_limit, std::move(why), 0.0};
    }
    const auto away = [&](const JointPositions& q) { return joint_step(arm, q, previous); };
    return {*std::ranges::min_element(found.branches, {}, away), ArmTrouble::none, {}, turned->tilt};
}

ArmHold by_search(const ArmModel& arm, const Frame& goal, const ArmAim& aim, const JointPositions& previous) {
    const ArmSolverResult found = solve_arm(arm, goal, aim.demand, previous);
    if (found.converged) {
        if (std::string why = leaves_zone(arm, previous, found.positions); !why.empty()) {
            return {previous, ArmTrouble::joint_limit, std::move(why), 0.0};
        }
        return {found.positions, ArmTrouble::none, {}, 0.0};
    }
    return {previous,
            ArmTrouble::out_of_reach,
            fmt::format("no position of the joints was found; the nearest one misses by {:.3f} mm and {:.3f} "
                        "deg",
                        found.tip_error,
                        to_degrees(found.angle_error)),
            0.0};
}

} // namespace

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

} // namespace millwright::kinematics
