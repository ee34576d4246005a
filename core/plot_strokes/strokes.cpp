#include "core/plot_strokes/strokes.h"

#include <cstddef>

namespace millwright::plot {

std::optional<Extents> extents(const Strokes& strokes) {
    std::optional<Extents> box;
    for (const Stroke& stroke : strokes) {
        for (const Vec2& point : stroke.points) {
            if (!box) {
                box = Extents{.lower = point, .upper = point};
            }
            box->lower = box->lower.cwiseMin(point);
            box->upper = box->upper.cwiseMax(point);
        }
    }
    return box;
}

double length(const Stroke& stroke) {
    double sum = 0.0;
    for (std::size_t n = 1; n < stroke.points.size(); ++n) {
        sum += (stroke.points[n] - stroke.points[n - 1]).norm();
    }
    return sum;
}

double draw_length(const Strokes& strokes) {
    double sum = 0.0;
    for (const Stroke& stroke : strokes) {
        sum += length(stroke);
    }
    return sum;
}

double air_length(const Strokes& strokes, const Vec2& start, const Vec2& end) {
    double sum = 0.0;
    Vec2 at = start;
    for (const Stroke& stroke : strokes) {
        sum += (stroke.points.front() - at).norm();
        at = stroke.points.back();
    }
    return sum + (end - at).norm();
}

} // namespace millwright::plot
