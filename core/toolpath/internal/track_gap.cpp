#include "core/toolpath/internal/track_gap.h"

#include "core/base/parallel.h"
#include "core/toolpath/internal/chord_curve.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace millwright::toolpath {

namespace {

/// A track on the surface as a polyline, `steps` chords a move.
std::vector<Vec3> track_line(const geometry::ParametricSurface& patch,
                             const grid::Grid& grid,
                             grid::TrackDirection direction,
                             int track,
                             int steps) {
    std::vector<Vec3> line;
    for (int k = 0; k + 1 < grid.nodes_per_track(direction); ++k) {
        const Vec2& a = grid.track_node(direction, track, k);
        const Vec2& b = grid.track_node(direction, track, k + 1);
        for (int s = line.empty() ? 0 : 1; s <= steps; ++s) {
            const double t = static_cast<double>(s) / steps;
            const Vec2 uv = (1.0 - t) * a + t * b;
            line.push_back(patch.position(uv.x(), uv.y()));
        }
    }
    return line;
}

/// Of the points of `from` to the line `to`, which goes along beside it. The points whose bounds are largest
/// come first: the search ends where no bound is above what was found (Taha and Hanbury, An Efficient
/// Algorithm for Calculating the Exact Hausdorff Distance, 2015).
double largest_distance(const std::vector<Vec3>& from, const std::vector<Vec3>& to) {
    const ChordCurve curve(to, std::vector<Vec3>(to.size(), Vec3::UnitZ()));
    std::vector<std::pair<double, std::size_t>> bounds(from.size());
    for (std::size_t n = 0; n < from.size(); ++n) {
        bounds[n] = {curve.squared_beside(from[n], n), n};
    }
    std::ranges::sort(bounds, std::greater());
    double squared = 0.0;
    for (const auto& [bound, n] : bounds) {
        if (bound <= squared) {
            break;
        }
        squared = std::max(squared, curve.nearest(from[n]).squared);
    }
    return std::sqrt(squared);
}

} // namespace

double largest_gap(const geometry::ParametricSurface& patch,
                   const grid::Grid& grid,
                   grid::TrackDirection direction) {
    constexpr int steps = 4;
    const int tracks = grid.track_count(direction);
    std::vector<std::vector<Vec3>> lines;
    for (int t = 0; t < tracks; ++t) {
        lines.push_back(track_line(patch, grid, direction, t, steps));
    }
    std::vector<double> gaps(static_cast<std::size_t>(tracks - 1));
    parallel_for(tracks - 1, 1, [&](std::ptrdiff_t t) {
        const auto n = static_cast<std::size_t>(t);
        gaps[n] =
            std::max(largest_distance(lines[n], lines[n + 1]), largest_distance(lines[n + 1], lines[n]));
    });
    return *std::max_element(gaps.begin(), gaps.end());
}

} // namespace millwright::toolpath
