#include "core/toolpath/zigzag.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::toolpath {

namespace {

geometry::ToolPose pose_at(const geometry::BezierPatch& patch, const Vec2& uv, bool flipped) {
    const geometry::SurfaceDerivatives at = patch.derivatives(uv.x(), uv.y());
    const auto normal = patch.unit_normal(at);
    if (!normal) {
        throw Error(
            fmt::format("the surface has no normal at u = {:.6g}, v = {:.6g}: its control points coincide "
                        "or its tangents are parallel there",
                        uv.x(),
                        uv.y()));
    }
    return {at.position, flipped ? Vec3(-*normal) : *normal};
}

} // namespace

double length(const Toolpath& toolpath) {
    double sum = 0.0;
    for (std::size_t n = 1; n < toolpath.points.size(); ++n) {
        sum += (toolpath.points[n].pose.tip - toolpath.points[n - 1].pose.tip).norm();
    }
    return sum;
}

Toolpath zigzag(const geometry::BezierPatch& patch,
                const grid::Grid& grid,
                grid::TrackDirection direction,
                bool flipped) {
    Toolpath toolpath;
    toolpath.direction = direction;
    const int tracks = grid.track_count(direction);
    const int nodes = grid.nodes_per_track(direction);
    for (int track = 0; track < tracks; ++track) {
        const bool backwards = track % 2 == 1;
        for (int step = 0; step < nodes; ++step) {
            const int node = backwards ? nodes - 1 - step : step;
            const Vec2& uv = grid.track_node(direction, track, node);
            PathPoint point;
            point.pose = pose_at(patch, uv, flipped);
            point.contact = point.pose.tip;
            point.normal = point.pose.axis;
            point.reached_by = step > 0 ? MoveKind::track : track > 0 ? MoveKind::cross : MoveKind::start;
            const bool along_v = direction == grid::TrackDirection::along_v;
            point.origin = {along_v ? track : node, along_v ? node : track, uv};
            toolpath.points.push_back(point);
        }
    }
    return toolpath;
}

} // namespace millwright::toolpath
