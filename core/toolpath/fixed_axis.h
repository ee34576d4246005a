// Machines without rotary axes: the tool keeps its axis, whatever the surface does. It is a point at the end
// of its axis, so that the tip is still on the surface.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/toolpath.h"

#include <optional>

namespace millwright::toolpath {

/// `pose` with the axis that the machine gives the tool: its own without rotary axes, else the pose's.
/// Nothing where such a tool would come from inside of the part.
[[nodiscard]] std::optional<geometry::ToolPose> pose_on(const kinematics::MachineModel& machine,
                                                        const geometry::ToolPose& pose);

/// Every point of `toolpath` with the axis of pose_on. Throws Error with the node of an undercut.
[[nodiscard]] Toolpath on_machine(const kinematics::MachineModel& machine, Toolpath toolpath);

} // namespace millwright::toolpath
