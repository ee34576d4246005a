#include "core/toolpath/zigzag.h"

#include "core/toolpath/trimmed_path.h"

namespace millwright::toolpath {

Toolpath zigzag(const geometry::ParametricSurface& patch,
                const grid::Grid& grid,
                grid::TrackDirection direction,
                bool flipped,
                const geometry::OutlineTree* outline) {
    Toolpath toolpath;
    toolpath.direction = direction;
    const int tracks = grid.track_count(direction);
    const int nodes = grid.nodes_per_track(direction);
    for (int track = 0; track < tracks; ++track) {
        const bool backwards = track % 2 == 1;
        for (int step = 0; step < nodes; ++step) {
            const int node = backwards ? nodes - 1 - step : step;
            const Vec2& uv = grid.track_node(direction, track, node);
            PathPoint point = point_to_trim(patch, outline, uv, flipped);
            point.reached_by = step > 0 ? MoveKind::track : track > 0 ? MoveKind::cross : MoveKind::start;
            point.origin = origin_at(direction, track, node, uv);
            toolpath.points.push_back(point);
        }
    }
    return toolpath;
}

} // namespace millwright::toolpath
