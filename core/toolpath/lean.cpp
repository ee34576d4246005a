#include "core/toolpath/lean.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::toolpath {

namespace {

/// The parameters of the neighbours on the track of point `n`, or its own at an end.
Vec2 step_at(const Toolpath& path, std::size_t n) {
    const bool first = path.points[n].reached_by != MoveKind::track;
    const bool last = n + 1 == path.points.size() || path.points[n + 1].reached_by != MoveKind::track;
    return path.points[last ? n : n + 1].origin.uv - path.points[first ? n : n - 1].origin.uv;
}

double along(const Toolpath& path, const Vec2& uv) {
    return path.direction == grid::TrackDirection::along_v ? uv.y() : uv.x();
}

} // namespace

bool Lean::upright() const {
    return *this == Lean{};
}

Vec3 leaning_axis(const Lean& lean, const Vec3& normal, const Vec3& feed, double along) {
    const double lead = lean.lead + along * lean.lead_change;
    const double tilt = lean.tilt + along * lean.tilt_change;
    const Vec3 right = feed.cross(normal);
    return (std::cos(lead) * (std::cos(tilt) * normal + std::sin(tilt) * right) + std::sin(lead) * feed)
        .normalized();
}

Vec3 surface_direction(const geometry::SurfaceDerivatives& at, const Vec2& step) {
    const Vec3 along = step.x() * at.du + step.y() * at.dv;
    const double length = along.norm();
    return length > 0.0 ? Vec3(along / length) : Vec3(Vec3::Zero());
}

Toolpath leaned(const geometry::BezierPatch& patch, const Lean& lean, Toolpath toolpath) {
    if (lean.upright()) {
        return toolpath;
    }
    for (std::size_t n = 0; n < toolpath.points.size(); ++n) {
        PathPoint& point = toolpath.points[n];
        const Vec2& uv = point.origin.uv;
        const Vec3 feed = surface_direction(patch.derivatives(uv.x(), uv.y()), step_at(toolpath, n));
        if (feed.squaredNorm() < 0.5) {
            throw Error(fmt::format("the track has no direction at node {},{}, so that the tool cannot lean",
                                    point.origin.i,
                                    point.origin.j));
        }
        point.pose.axis = leaning_axis(lean, point.normal, feed, along(toolpath, uv));
    }
    return toolpath;
}

} // namespace millwright::toolpath
