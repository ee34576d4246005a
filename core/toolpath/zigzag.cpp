#include "core/toolpath/zigzag.h"

#include "core/toolpath/internal/contact_point.h"

namespace millwright::toolpath {

double length(const Toolpath& toolpath) {
    double sum = 0.0;
    for (std::size_t n = 1; n < toolpath.points.size(); ++n) {
        if (toolpath.points[n].reached_by != MoveKind::over) {
            sum += (toolpath.points[n].pose.tip - toolpath.points[n - 1].pose.tip).norm();
        }
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
            PathPoint point = contact_point(patch, uv, flipped);
            point.reached_by = step > 0 ? MoveKind::track : track > 0 ? MoveKind::cross : MoveKind::start;
            const bool along_v = direction == grid::TrackDirection::along_v;
            point.origin.i = along_v ? track : node;
            point.origin.j = along_v ? node : track;
            toolpath.points.push_back(point);
        }
    }
    return toolpath;
}

} // namespace millwright::toolpath
