#include "core/toolpath/toolpath.h"

namespace millwright::toolpath {

using grid::TrackDirection;

GridOrigin origin_at(TrackDirection direction, int track, int node, const Vec2& uv) {
    return direction == TrackDirection::along_v ? GridOrigin{track, node, uv} : GridOrigin{node, track, uv};
}

int track_of(TrackDirection direction, const GridOrigin& origin) {
    return direction == TrackDirection::along_v ? origin.i : origin.j;
}

double length(const Toolpath& toolpath) {
    double sum = 0.0;
    for (std::size_t n = 1; n < toolpath.points.size(); ++n) {
        if (toolpath.points[n].reached_by != MoveKind::over) {
            sum += (toolpath.points[n].pose.tip - toolpath.points[n - 1].pose.tip).norm();
        }
    }
    return sum;
}

} // namespace millwright::toolpath
