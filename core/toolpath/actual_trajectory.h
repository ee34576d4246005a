// What the tool really does between two poses: the machine interpolates its axes linearly, the part sees a
// curve. Source: Parasilmongkol 1997, ch. 3.4: M(t), A(t), B(t) linear in t, W(t) = inverse map of them.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::toolpath {

/// The tool pose on the part at t in [0,1] of the move from `a` to `b`.
[[nodiscard]] geometry::ToolPose actual_pose(const kinematics::MachineModel& machine,
                                             const kinematics::AxisPositions& a,
                                             const kinematics::AxisPositions& b,
                                             double t);

/// Poses at `count` equal steps, both ends included. Throws Defect if count < 2.
[[nodiscard]] std::vector<geometry::ToolPose> actual_poses(const kinematics::MachineModel& machine,
                                                           const kinematics::AxisPositions& a,
                                                           const kinematics::AxisPositions& b,
                                                           int count);

} // namespace millwright::toolpath
