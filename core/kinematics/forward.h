// Forward kinematics: where the tool is on the part for given axis positions, and how it moves with them.
// Product of exponentials (Murray, Li, Sastry, A Mathematical Introduction to Robotic Manipulation, ch. 3):
// each axis acts by its direction and point at the physical zero, so no frames need to be carried along.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"

namespace millwright::kinematics {

/// The tool pose in workpiece coordinates. `positions` has axis_count() entries.
[[nodiscard]] geometry::ToolPose forward(const MachineModel& machine, const AxisPositions& positions);

/// Columns: one an axis. Rows 0-2: d tip / d position; rows 3-5: d axis / d position (mm, rad).
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::ColMajor, 6, 9>;
[[nodiscard]] Jacobian jacobian(const MachineModel& machine, const AxisPositions& positions);

/// With the rotary axes fixed the tip is an affine function of the linear ones.
struct LinearMap {
    Vec3 tip_at_zero; ///< workpiece coordinates, linear axes programmed to 0
    Mat3 columns;     ///< d tip / d position of linear_axes(), unit vectors
};
/// The linear `positions` do not matter.
[[nodiscard]] LinearMap linear_map(const MachineModel& machine, const AxisPositions& positions);

/// The motion of what `letter` carries ('\0': the base): maps points of m at the physical zero to m now.
[[nodiscard]] Frame carrier_motion(const MachineModel& machine, const AxisPositions& positions, char letter);

/// Workpiece coordinates to machine coordinates now.
[[nodiscard]] Frame m_T_w(const MachineModel& machine, const AxisPositions& positions);

} // namespace millwright::kinematics
