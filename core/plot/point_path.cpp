#include "core/plot/point_path.h"

#include <algorithm>

namespace millwright::plot {

namespace {

/// The height up to which points are in the work.
double top_of(const std::vector<Vec3>& points) {
    const auto lowest = std::ranges::min_element(points, {}, [](const Vec3& point) { return point.z(); });
    constexpr double last_digit = 1e-9;
    return std::max(lowest->z(), 0.0) + last_digit;
}

CutMove move_between(const Vec3& from, const Vec3& to, double top) {
    const bool begins = from.z() <= top;
    const bool ends = to.z() <= top;
    if (!ends) {
        return begins ? CutMove::retract : CutMove::rapid;
    }
    if (!(to - from).head<2>().isZero(0.0)) {
        return CutMove::cut;
    }
    return to.z() < from.z() ? CutMove::plunge : CutMove::retract;
}

} // namespace

CutPath path_of_points(const std::vector<Vec3>& points, const PointPathSettings& settings) {
    CutPath path;
    if (points.empty()) {
        return path;
    }
    const double top = top_of(points);
    const auto above = [&](const Vec3& point) {
        return Vec3(point.x(), point.y(), std::max(point.z(), settings.safe_height));
    };
    const auto speed_of = [&](CutMove move) {
        return move == CutMove::cut ? settings.cutting : move == CutMove::plunge ? settings.plunging : 0.0;
    };
    Vec3 at = above(points.front());
    path.push_back({.at = at, .speed = 0.0, .move = CutMove::rapid, .tool = 1});
    for (const Vec3& point : points) {
        if (point != at) {
            const CutMove move = move_between(at, point, top);
            path.push_back({.at = point, .speed = speed_of(move), .move = move, .tool = 1});
            at = point;
        }
    }
    if (at.z() < settings.safe_height) {
        path.push_back({.at = above(at), .speed = 0.0, .move = CutMove::retract, .tool = 1});
    }
    return path;
}

Strokes strokes_of_points(const std::vector<Vec3>& points) {
    Strokes strokes;
    bool down = false;
    const CutPath path = path_of_points(points);
    for (std::size_t n = 1; n < path.size(); ++n) {
        const Vec2 from = path[n - 1].at.head<2>();
        const Vec2 to = path[n].at.head<2>();
        const bool cuts = path[n].move == CutMove::cut && to != from;
        if (cuts && !down) {
            strokes.push_back({.pen = 1, .points = {from}});
        }
        if (cuts) {
            strokes.back().points.push_back(to);
        }
        down = cuts;
    }
    return strokes;
}

} // namespace millwright::plot
