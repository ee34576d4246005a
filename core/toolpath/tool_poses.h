// From the points that the tool touches to its poses: the tool leans, the machine has its say about the axis,
// and the tip is where the cutter touches the contact. Formulas: docs/reference/cutter.md.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "core/geometry/tool_pose.h"
#include "core/kinematics/machine_model.h"
#include "core/toolpath/toolpath.h"

#include <optional>

namespace millwright::toolpath {

// Machines without rotary axes: the tool keeps its axis, whatever the surface does. It is a point at the end
// of its axis, so that the tip is still on the surface.

/// `pose` with the axis that the machine gives the tool: its own without rotary axes, else the pose's.
/// Nothing where such a tool would come from inside of the part.
[[nodiscard]] std::optional<geometry::ToolPose> pose_on(const kinematics::MachineModel& machine,
                                                        const geometry::ToolPose& pose);

/// Every point of `toolpath` with the axis of pose_on. Throws Error with the node of an undercut.
[[nodiscard]] Toolpath on_machine(const kinematics::MachineModel& machine, Toolpath toolpath);

/// `contacts`, a path of a point along the normal, as the path of `tool` on `machine`. The direction of the
/// move at a point is that from the point before to the one after on its track. Throws Error with the node
/// where a track has no direction and the tool leans, and where a machine without rotary axes cannot turn to
/// the surface.
[[nodiscard]] Toolpath with_tool(const geometry::ParametricSurface& patch,
                                 const kinematics::MachineModel& machine,
                                 const Tool& tool,
                                 Toolpath contacts);

/// In which the parameters change at point `n` of the path, not scaled.
[[nodiscard]] Vec2 heading_at(const Toolpath& path, std::size_t n);

/// The pose that the path's tool is to have at the parameters `uv` of a track that goes along `heading`
/// there; `normal` is that of the surface on the side of the tool. Where the heading vanishes it does not
/// lean.
[[nodiscard]] geometry::ToolPose intended_pose(const geometry::ParametricSurface& patch,
                                               const kinematics::MachineModel& machine,
                                               const Toolpath& path,
                                               const Vec2& uv,
                                               const Vec2& heading,
                                               const Vec3& normal);

/// The axis of that pose on a machine that can turn the tool.
[[nodiscard]] Vec3 intended_axis(const geometry::ParametricSurface& patch,
                                 const Toolpath& path,
                                 const Vec2& uv,
                                 const Vec2& heading,
                                 const Vec3& normal);

} // namespace millwright::toolpath
