#include "core/plot/compensation.h"

#include "core/base/error.h"
#include "core/plot/internal/clipper_paths.h"
#include "core/plot/internal/point_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::plot {
namespace {

/// Rings that neither cross nor overlap, outer ones counter-clockwise, holes clockwise.
ClipperLib::Paths simple(const Region& region) {
    ClipperLib::Paths paths = internal::to_clipper(region);
    ClipperLib::SimplifyPolygons(paths, ClipperLib::pftEvenOdd);
    return paths;
}

Strokes closed_strokes(const Region& region, int pen) {
    Strokes strokes;
    for (const Ring& ring : region) {
        Stroke stroke{.pen = pen, .points = ring};
        stroke.points.push_back(ring.front());
        strokes.push_back(std::move(stroke));
    }
    return strokes;
}

/// Clipper begins its rings anywhere and gives them in any order. Here each begins where it is nearest to the
/// beginning of a ring as drawn, and they come in the order of those.
Region begun_as(const Region& drawn, Region found) {
    std::vector<Vec2> begins;
    for (const Ring& ring : drawn) {
        if (!ring.empty()) {
            begins.push_back(ring.front());
        }
    }
    const internal::PointGrid grid(begins);
    std::vector<std::pair<int, Ring>> rings;
    for (Ring& ring : found) {
        std::size_t first = 0;
        int like = -1;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const int near = grid.nearest(ring[n]);
            const double distance = (begins[static_cast<std::size_t>(near)] - ring[n]).norm();
            if (distance < least) {
                least = distance;
                like = near;
                first = n;
            }
        }
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first), ring.end());
        rings.emplace_back(like, std::move(ring));
    }
    std::ranges::stable_sort(rings, {}, &std::pair<int, Ring>::first);
    found.clear();
    for (auto& [like, ring] : rings) {
        found.push_back(std::move(ring));
    }
    return found;
}

} // namespace

Region offset(const Region& region, double distance, Corners corners, double arc_tolerance) {
    return internal::from_clipper(internal::offset_paths(simple(region), distance, corners, arc_tolerance));
}

Strokes compensated(const Region& region, const CompensationSettings& settings, int pen) {
    if (!(settings.tool_diameter > 0.0)) {
        throw Error(fmt::format("the tool diameter {} mm is not valid", settings.tool_diameter));
    }
    if (settings.side == CutterSide::on_line) {
        return closed_strokes(region, pen);
    }
    const double radius = settings.tool_diameter / 2.0;
    const double distance = settings.side == CutterSide::outside ? radius : -radius;
    return closed_strokes(
        begun_as(region, offset(region, distance, settings.corners, settings.arc_tolerance)), pen);
}

Strokes contour_hatch(const Region& region, double first, double pitch, int pen) {
    constexpr int most_contours = 100'000;
    if (!(pitch > 0.0) || !(first >= 0.0)) {
        throw Error("contours need a pitch above 0 and must start at or inside the outline");
    }
    Strokes strokes;
    for (int n = 0; n < most_contours; ++n) {
        // From the outline each time: errors of one contour do not go on to the next.
        const Region ring = offset(region, -(first + n * pitch), Corners::sharp);
        if (ring.empty()) {
            return strokes;
        }
        for (Stroke& stroke : closed_strokes(ring, pen)) {
            strokes.push_back(std::move(stroke));
        }
    }
    throw Error(fmt::format("more than {} contours are needed: the pitch is too small", most_contours));
}

} // namespace millwright::plot
