#include "core/toolpath/tool_poses.h"

#include "core/base/error.h"
#include "core/toolpath/cutter.h"

#include <fmt/format.h>

#include <utility>

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

namespace {

double along_track(grid::TrackDirection direction, const Vec2& uv) {
    return direction == grid::TrackDirection::along_v ? uv.y() : uv.x();
}

/// The unit direction on the surface in which the parameters change by `step`; zero where there is none.
Vec3 direction_on(const geometry::ParametricSurface& patch, const Vec2& uv, const Vec2& step) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    const Vec3 along = step.x() * at.du + step.y() * at.dv;
    const double length = along.norm();
    return length > 0.0 ? Vec3(along / length) : Vec3(Vec3::Zero());
}

void lean_over(const geometry::ParametricSurface& patch, const Lean& lean, Toolpath& path) {
    for (std::size_t n = 0; n < path.points.size(); ++n) {
        PathPoint& point = path.points[n];
        const Vec2& uv = point.origin.uv;
        const Vec3 feed = direction_on(patch, uv, heading_at(path, n));
        if (feed.squaredNorm() < 0.5) {
            throw Error(
                fmt::format("the track has no direction at node {},{}, so lead and tilt are undefined there",
                            point.origin.i,
                            point.origin.j));
        }
        point.pose.axis = leaning_axis(lean, point.normal, feed, along_track(path.direction, uv));
    }
}

} // namespace

Vec2 heading_at(const Toolpath& path, std::size_t n) {
    const bool first = path.points[n].reached_by != MoveKind::track;
    const bool last = n + 1 == path.points.size() || path.points[n + 1].reached_by != MoveKind::track;
    return path.points[last ? n : n + 1].origin.uv - path.points[first ? n : n - 1].origin.uv;
}

Vec3 intended_axis(const geometry::ParametricSurface& patch,
                   const Toolpath& path,
                   const Vec2& uv,
                   const Vec2& heading,
                   const Vec3& normal) {
    const Lean& lean = path.tool.lean;
    if (lean.upright()) {
        return normal;
    }
    const Vec3 feed = direction_on(patch, uv, heading);
    return feed.squaredNorm() < 0.5 ? normal
                                    : leaning_axis(lean, normal, feed, along_track(path.direction, uv));
}

geometry::ToolPose intended_pose(const geometry::ParametricSurface& patch,
                                 const kinematics::MachineModel& machine,
                                 const Toolpath& path,
                                 const Vec2& uv,
                                 const Vec2& heading,
                                 const Vec3& normal) {
    const Vec3 contact = patch.position(uv.x(), uv.y());
    const Vec3 axis = machine.rotary_axes().empty() ? machine.description().tool_axis
                                                    : intended_axis(patch, path, uv, heading, normal);
    return {path.tool.cutter ? tip_for(*path.tool.cutter, contact, normal, axis) : contact, axis};
}

Toolpath with_tool(const geometry::ParametricSurface& patch,
                   const kinematics::MachineModel& machine,
                   const Tool& tool,
                   Toolpath contacts) {
    Toolpath path = std::move(contacts);
    path.tool = tool;
    if (!tool.lean.upright()) {
        lean_over(patch, tool.lean, path);
    }
    path = on_machine(machine, std::move(path));
    if (tool.cutter) {
        for (PathPoint& point : path.points) {
            point.pose.tip = tip_for(*tool.cutter, point.contact, point.normal, point.pose.axis);
        }
    }
    return path;
}

} // namespace millwright::toolpath
