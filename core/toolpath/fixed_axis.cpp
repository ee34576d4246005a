#include "core/toolpath/fixed_axis.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::toolpath {

std::optional<geometry::ToolPose> pose_on(const kinematics::MachineModel& machine,
                                          const geometry::ToolPose& pose) {
    if (!machine.rotary_axes().empty()) {
        return pose;
    }
    const Vec3& tool = machine.description().tool_axis;
    return pose.axis.dot(tool) > 0.0 ? std::optional(geometry::ToolPose{pose.tip, tool}) : std::nullopt;
}

Toolpath on_machine(const kinematics::MachineModel& machine, Toolpath toolpath) {
    for (PathPoint& point : toolpath.points) {
        const std::optional<geometry::ToolPose> pose = pose_on(machine, point.pose);
        if (!pose) {
            throw Error(
                fmt::format(
                    "the surface at node {},{} faces away from the tool, and machine '{}' cannot rotate it",
                    point.origin.i,
                    point.origin.j,
                    machine.name()),
                {},
                "machine the opposite side, or choose a machine with rotary axes");
        }
        point.pose = *pose;
    }
    return toolpath;
}

} // namespace millwright::toolpath
