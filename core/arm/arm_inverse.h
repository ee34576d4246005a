// Inverse kinematics of an arm of the kind PlanarElbow, in closed form: every branch (base turned to the goal
// or over its back, elbow up or down). Saengsasri, Nittayachin 1996, KMITL, section 1.3, corrected in
// docs/reference/arm.md. Lengths mm, angles rad, in the base's frame.
#pragma once

#include "core/arm/arm_model.h"
#include "core/kinematics/inverse.h"

#include <optional>

namespace millwright::arm {

/// The tip and the direction of the tool axis (z of the tool, unit); the roll about it is free.
struct PointedGoal {
    Vec3 tip = Vec3::Zero();
    Vec3 axis = Vec3::UnitZ();
};

/// A tool axis may lie so far out of the plane of the arm, rad; the plane holds the base's axis and the tip.
inline constexpr double in_plane_tolerance = 1e-7;
/// A tip nearer than this to the base's axis leaves the base free to turn, mm.
inline constexpr double base_axis_tolerance = 1e-9;

struct ArmInverseSolution : kinematics::InverseSolution {
    // Where there is no branch:
    double beyond_reach = 0.0; ///< of the wrist, mm: too far from the shoulder or too near; 0 if neither
    JointExcess excess;        ///< of the branch that is nearest to its limits; no joint if there is none
    double out_of_plane = 0.0; ///< of the tool axis, rad, where it is too much
};

/// Solves for a goal with its roll. Angles are the turns inside the limits next to `previous`; branches in
/// the order elbow up and down to the front, then over the back. Where the goal leaves a joint free,
/// `previous` tells it and the answer is Reach::singular. Out of reach is an answer with its reason. Throws
/// Defect for an arm of another kind and for a goal that is no rigid motion.
[[nodiscard]] ArmInverseSolution
arm_inverse(const ArmModel& arm, const Frame& goal, const JointPositions& previous);
/// The same with the roll as in `previous`.
[[nodiscard]] ArmInverseSolution
arm_inverse(const ArmModel& arm, const PointedGoal& goal, const JointPositions& previous);

/// The goal turned by the smallest angle so that its tool axis lies in the plane of the arm. Nothing if the
/// tool axis is across that plane, where two directions are as near.
[[nodiscard]] std::optional<Frame> projected_goal(const Frame& goal);
/// The same of a tool axis (unit) alone.
[[nodiscard]] std::optional<Vec3> projected_axis(const PointedGoal& goal);

} // namespace millwright::arm
