#include "core/arm/arm_inverse.h"

#include "core/base/error.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace millwright::arm {

namespace {

constexpr double rigid = 1e-6;      // how far a rotation's columns may be off
constexpr double stretched = 1e-10; // of a cosine: rounding at the border of the reach

double distance_to_base_axis(const Vec3& tip) {
    return std::hypot(tip.x(), tip.y());
}

/// Across the plane of the arm that holds the tip.
Vec3 plane_normal(const Vec3& tip) {
    return Vec3(-tip.y(), tip.x(), 0.0) / distance_to_base_axis(tip);
}

/// The angle of the base to the front, and whether the goal tells it.
struct BaseAngle {
    double angle = 0.0;
    bool is_free = false;
};

BaseAngle base_angle(const PointedGoal& goal, double previous) {
    constexpr double upright = 1e-9; // horizontal part of the tool axis
    if (distance_to_base_axis(goal.tip) > base_axis_tolerance) {
        return {std::atan2(goal.tip.y(), goal.tip.x())};
    }
    if (std::hypot(goal.axis.x(), goal.axis.y()) > upright) {
        return {std::atan2(goal.axis.y(), goal.axis.x())};
    }
    return {previous, true};
}

/// Angles of the three parallel joints about their axis, and their sum, from the wrist in their plane.
struct PlaneAngles {
    double shoulder = 0.0;
    double elbow = 0.0;
};

std::vector<PlaneAngles> plane_angles(const PlanarElbow& arm, double forward, double down, double cosine) {
    const double c3 = std::clamp(cosine, -1.0, 1.0);
    const double s3 = std::sqrt((1.0 - c3) * (1.0 + c3));
    std::vector<PlaneAngles> found;
    for (const double sine : {s3, -s3}) {
        const double beta = std::atan2(arm.forearm * sine, arm.upper_arm + arm.forearm * c3);
        found.push_back({std::atan2(down, forward) - beta, std::atan2(sine, c3)});
        if (s3 < stretched) {
            break; // both are the same
        }
    }
    return found;
}

/// Of the angle between upper arm and forearm, by the law of cosines; beyond 1 where they do not reach.
double elbow_cosine(const PlanarElbow& arm, const Vec3& wrist) {
    const double lengths = arm.upper_arm * arm.upper_arm + arm.forearm * arm.forearm;
    return (wrist.squaredNorm() - lengths) / (2.0 * arm.upper_arm * arm.forearm);
}

/// `angle` as a position of `joint`, in the turn inside its limits that is nearest to `previous`, or nearest
/// at all where none is inside.
double turned_inside(const ArmJoint& joint, double angle, double previous) {
    constexpr double turn = 2.0 * pi;
    constexpr double touching = 1e-9; // rad: rounding takes nothing out of its limits
    const double near = angle + turn * std::round((previous - angle) / turn);
    double lifted = near;
    while (lifted < joint.min - touching) {
        lifted += turn;
    }
    while (lifted > joint.max + touching) {
        lifted -= turn;
    }
    const bool fits = lifted >= joint.min - touching && lifted <= joint.max + touching;
    return fits ? std::clamp(lifted, joint.min, joint.max) : near;
}

std::string joint_limit_sentence(const ArmModel& arm, const JointPositions& positions, int n) {
    const ArmJoint& joint = arm.joint(n);
    return fmt::format("joint {} would have to move to {:.3f} deg, outside {:.3f} to {:.3f}",
                       joint.name,
                       to_degrees(positions[n]),
                       to_degrees(joint.min),
                       to_degrees(joint.max));
}

/// How far the wrist can be from the shoulder inside the limits of joint 3, mm.
struct WristSpan {
    double least = 0.0, most = 0.0;
};

WristSpan wrist_span(const ArmModel& arm, const PlanarElbow& lengths) {
    constexpr double turn = 2.0 * pi;
    const ArmJoint& elbow = arm.joint(2);
    const double first = elbow.min + elbow.theta, last = elbow.max + elbow.theta;
    const auto passes = [&](double angle) {
        return std::ceil((first - angle) / turn) * turn + angle <= last;
    };
    const auto distance = [&](double cosine) {
        const double squares = lengths.upper_arm * lengths.upper_arm + lengths.forearm * lengths.forearm;
        return std::sqrt(std::max(0.0, squares + 2.0 * lengths.upper_arm * lengths.forearm * cosine));
    };
    const bool everywhere = !(last - first < turn); // also without limits
    return {distance(everywhere || passes(pi) ? -1.0 : std::min(std::cos(first), std::cos(last))),
            distance(everywhere || passes(0.0) ? 1.0 : std::max(std::cos(first), std::cos(last)))};
}

/// Of a wrist that joint 3 cannot bring so far from the shoulder or so near; unchanged where it can.
void explain_wrist(ArmInverseSolution& found, const ArmModel& arm, double distance) {
    constexpr double rounding_mm = 1e-6;
    const WristSpan span = wrist_span(arm, *arm.planar_elbow());
    const double beyond = std::max(span.least - distance, distance - span.most);
    if (beyond > rounding_mm) {
        found.beyond_reach = beyond;
        found.why = fmt::format(
            "the wrist would be {:.3f} mm from the shoulder, but the arm reaches from {:.3f} to {:.3f}",
            distance,
            span.least,
            span.most);
    }
}

/// Angles about the joints' axes as positions, where the limits allow them; else why not, of the branch that
/// is nearest to its limits.
void add_branch(ArmInverseSolution& found,
                const ArmModel& arm,
                const std::array<double, 5>& angles,
                const JointPositions& previous) {
    JointPositions positions(5);
    for (int n = 0; n < 5; ++n) {
        const ArmJoint& joint = arm.joint(n);
        const double angle = angles[static_cast<std::size_t>(n)] - joint.theta;
        positions[n] = turned_inside(joint, angle, previous[n]);
    }
    const JointExcess excess = arm.farthest_outside(positions);
    if (excess.joint < 0) {
        found.branches.push_back(positions);
    } else if (found.excess.joint < 0 || excess.beyond < found.excess.beyond) {
        found.excess = excess;
        found.why = joint_limit_sentence(arm, positions, excess.joint);
    }
}

/// `roll`: the angle of joint 5 for a given angle of the base.
template <class Roll>
ArmInverseSolution
solve(const ArmModel& arm, const PointedGoal& goal, const JointPositions& previous, Roll&& roll) {
    expects(arm.planar_elbow().has_value(), "an arm of three parallel joints between base and roll");
    expects(previous.size() == arm.joint_count() && previous.allFinite(), "a position for every joint");
    const BaseAngle front = base_angle(goal, previous[0] + arm.joint(0).theta);
    const Vec3 across(-std::sin(front.angle), std::cos(front.angle), 0.0);
    const double out_of_plane = std::asin(std::clamp(across.dot(goal.axis), -1.0, 1.0));
    ArmInverseSolution found;
    if (std::abs(out_of_plane) > in_plane_tolerance) {
        found.out_of_plane = std::abs(out_of_plane);
        found.why =
            fmt::format("the tool axis is {:.4f} deg out of the plane of the arm, which has only five joints",
                        to_degrees(found.out_of_plane));
        return found;
    }
    const PlanarElbow& lengths = *arm.planar_elbow();
    const Vec3 axis = (goal.axis - across.dot(goal.axis) * across).normalized();
    const Vec3 wrist = goal.tip - lengths.tool * axis;
    const double cosine = elbow_cosine(lengths, wrist);
    if (!(std::abs(cosine) <= 1.0 + stretched)) {
        explain_wrist(found, arm, wrist.norm());
        return found;
    }
    found.reach = front.is_free ? kinematics::Reach::singular : kinematics::Reach::reachable;
    for (const double base : {front.angle, front.angle + pi}) {
        const double c1 = std::cos(base), s1 = std::sin(base);
        const double sum = std::atan2(c1 * axis.x() + s1 * axis.y(), axis.z());
        const double forward = c1 * wrist.x() + s1 * wrist.y();
        for (const PlaneAngles& angles : plane_angles(lengths, forward, -wrist.z(), cosine)) {
            const double flexion = sum - angles.shoulder - angles.elbow;
            add_branch(found, arm, {base, angles.shoulder, angles.elbow, flexion, roll(base)}, previous);
        }
    }
    if (found.branches.empty()) {
        found.reach = kinematics::Reach::outside_limits;
        explain_wrist(found, arm, wrist.norm()); // whatever the other joints do
    } else {
        found.why.clear();
        found.excess = {};
    }
    return found;
}

} // namespace

ArmInverseSolution arm_inverse(const ArmModel& arm, const Frame& goal, const JointPositions& previous) {
    const Mat3 r = goal.linear();
    expects(is_finite(Vec3(goal.translation())) && r.isUnitary(rigid) && r.determinant() > 0.0,
            "a goal is a rigid motion");
    const auto roll = [&](double base) {
        const double c1 = std::cos(base), s1 = std::sin(base);
        return std::atan2(c1 * r(1, 0) - s1 * r(0, 0), c1 * r(1, 1) - s1 * r(0, 1));
    };
    return solve(arm, {goal.translation(), r.col(2)}, previous, roll);
}

ArmInverseSolution arm_inverse(const ArmModel& arm, const PointedGoal& goal, const JointPositions& previous) {
    expects(is_finite(goal.tip) && std::abs(goal.axis.norm() - 1.0) < rigid, "a tool axis is a unit vector");
    return solve(arm, goal, previous, [&](double) { return previous[4] + arm.joint(4).theta; });
}

std::optional<Vec3> projected_axis(const PointedGoal& goal) {
    if (distance_to_base_axis(goal.tip) <= base_axis_tolerance) {
        return goal.axis; // a plane through the tool axis is always there
    }
    constexpr double across = 1e-12; // length of what is left of the tool axis in the plane
    const Vec3 m = plane_normal(goal.tip);
    const Vec3 in_plane = goal.axis - m.dot(goal.axis) * m;
    return in_plane.norm() < across ? std::nullopt : std::optional<Vec3>(in_plane.normalized());
}

std::optional<Frame> projected_goal(const Frame& goal) {
    const Vec3 axis = goal.linear().col(2);
    const std::optional<Vec3> in_plane = projected_axis({goal.translation(), axis});
    if (!in_plane) {
        return std::nullopt;
    }
    Frame projected = goal;
    projected.linear() =
        Eigen::Quaterniond::FromTwoVectors(axis, *in_plane).toRotationMatrix() * goal.linear();
    return projected;
}

} // namespace millwright::arm
