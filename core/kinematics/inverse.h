// Inverse kinematics: every axis position that puts the tool at a given pose on the part.
// Lengths mm, angles rad. Closed form for any two rotary axes (Paden-Kahan sub-problem 2; Murray, Li, Sastry,
// ch. 3.3); for the theses' rotary-tilt machine it equals Parasilmongkol 1997, ch. 3, corrected in
// docs/reference/kinematics.md.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"

#include <span>
#include <string>
#include <vector>

namespace millwright::kinematics {

/// What the machine can do about a pose. At a pole (`singular`) one rotary angle is free.
enum class Reach { reachable, singular, outside_limits, unreachable };

struct InverseSolution {
    Reach reach = Reach::unreachable;
    std::vector<AxisPositions> branches; ///< all inside the limits, ascending in the rotary axes
    std::string why;                     ///< a sentence where there is no branch
};

/// A tool axis nearer than this to the direction of the free rotary axis counts as lying on the pole, rad.
inline constexpr double pole_tolerance = 1e-7;

/// Whether there are two rotary axes or none; else the functions below throw Error.
[[nodiscard]] bool has_inverse(const MachineModel& machine);

/// Solves for `pose`; forward(machine, branch) returns to its tip within `round_trip_mm` for each branch.
/// Rotary axes with limits are given in every turn that fits, those without in the turn nearest to
/// `previous`. At a pole the free angle is taken from `previous`, so that a path does not spin there. Out of
/// reach is an answer. Throws Defect if `pose` is not finite or its axis is not a unit vector.
[[nodiscard]] InverseSolution
inverse(const MachineModel& machine, const geometry::ToolPose& pose, const AxisPositions& previous);

inline constexpr double round_trip_mm = 1e-10; // about 1000 ulp at 1 m

/// The same without regard to limits and turns: rotary angles as near as possible to `previous`, up to two
/// branches, nothing but geometry. Empty where the axis cannot be reached.
[[nodiscard]] std::vector<AxisPositions>
inverse_branches(const MachineModel& machine, const geometry::ToolPose& pose, const AxisPositions& previous);

/// The linear axis positions that bring the tool tip to `tip` with the rotary ones as in `positions`.
[[nodiscard]] AxisPositions
with_tip_at(const MachineModel& machine, AxisPositions positions, const Vec3& tip);

/// True if the tool axis lies at a pole, where the rotary axis next to the workpiece is free.
[[nodiscard]] bool at_pole(const MachineModel& machine, const Vec3& tool_axis);

/// The pole direction in workpiece coordinates (unit) for a machine with rotary axes: the tool axes +pole and
/// -pole leave one rotary angle free. Table-side innermost axis.
[[nodiscard]] Vec3 pole_direction(const MachineModel& machine);

// Choosing among the branches of the inverse kinematics.

/// Sum of the rotary axes' travel from `a` to `b`, rad.
[[nodiscard]] double
rotary_travel(const MachineModel& machine, const AxisPositions& a, const AxisPositions& b);

/// The branch with the least rotary travel from `previous`; the first of equals. Throws Defect if there is
/// none.
[[nodiscard]] const AxisPositions& nearest_branch(const MachineModel& machine,
                                                  std::span<const AxisPositions> branches,
                                                  const AxisPositions& previous);

} // namespace millwright::kinematics
