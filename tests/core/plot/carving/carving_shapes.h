// Outlines whose medial axis is known, and what is measured by brute force.
#pragma once

#include "core/base/units.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot_strokes/region.h"
#include "core/plot_strokes/strokes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace millwright::plot {

inline Ring box_ring(const Vec2& lower, const Vec2& upper) {
    return {lower, {upper.x(), lower.y()}, upper, {lower.x(), upper.y()}};
}

inline Ring disc_ring(const Vec2& middle, double radius, int count) {
    Ring ring;
    for (int n = 0; n < count; ++n) {
        const double angle = 2.0 * pi * n / count;
        ring.emplace_back(middle + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

/// Two arms 20 mm wide; the corner between them is at (20, 20).
inline Region ell() {
    return {{{0, 0}, {40, 0}, {40, 20}, {20, 20}, {20, 40}, {0, 40}}};
}

/// A letter A with its hole.
inline Region letter() {
    return {{{0, 0}, {6, 0}, {8, 7}, {16, 7}, {18, 0}, {24, 0}, {15, 30}, {9, 30}},
            {{9.5, 12}, {14.5, 12}, {12, 21}}};
}

/// A star of points at random distances, with a hole in its middle.
inline Region random_star(unsigned seed, int points) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> distance(6.0, 20.0);
    Ring ring;
    for (int n = 0; n < points; ++n) {
        const double angle = 2.0 * pi * n / points;
        ring.emplace_back(distance(random) * Vec2(std::cos(angle), std::sin(angle)));
    }
    return {ring, disc_ring(Vec2::Zero(), 3.0, 7)};
}

/// A flower of seven petals.
inline Ring petals(int count) {
    Ring ring;
    for (int n = 0; n < count; ++n) {
        const double angle = 2.0 * pi * n / count;
        ring.emplace_back((13.0 + 5.0 * std::sin(7.0 * angle)) * Vec2(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

inline Region turned(Region region, double angle, double scale) {
    const Eigen::Rotation2Dd turn(angle);
    for (Ring& ring : region) {
        for (Vec2& p : ring) {
            p = scale * (turn * p) + Vec2(7.0, -3.0);
        }
    }
    return region;
}

inline Strokes strokes_around(const Region& region) {
    Strokes strokes;
    for (const Ring& ring : region) {
        Stroke stroke{.points = ring};
        stroke.points.push_back(ring.front());
        strokes.push_back(std::move(stroke));
    }
    return strokes;
}

/// To the nearest outline.
inline double brute_clearance(const Region& region, const Vec2& place) {
    double best = std::numeric_limits<double>::infinity();
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2& a = ring[n];
            const Vec2 along = ring[(n + 1) % ring.size()] - a;
            const double t = std::clamp((place - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
            best = std::min(best, (a + t * along - place).norm());
        }
    }
    return best;
}

/// Places of the path in the work, no farther apart than `step`.
inline std::vector<Vec3> places_in_work(const CutPath& path, double step) {
    std::vector<Vec3> places;
    for (std::size_t n = 1; n < path.size(); ++n) {
        if (path[n].move == CutMove::plunge) {
            places.push_back(path[n].at);
        }
        if (path[n].move == CutMove::cut) {
            const Vec3 way = path[n].at - path[n - 1].at;
            const double parts = std::max(1.0, std::ceil(way.norm() / step));
            for (double k = 1.0; k <= parts; k += 1.0) {
                places.emplace_back(path[n - 1].at + k / parts * way);
            }
        }
    }
    return places;
}

/// How deep the union of the tool at all places is at `place`.
inline double carved_depth(const std::vector<Vec3>& places, const ToolTip& tip, const Vec2& place) {
    double depth = 0.0;
    for (const Vec3& at : places) {
        depth = std::max(depth, -at.z() - rise(tip, (at.head<2>() - place).norm()));
    }
    return depth;
}

/// Places inside the region, at random, the same for the same seed.
inline std::vector<Vec2> places_inside(const Region& region, int count, unsigned seed) {
    std::mt19937 random(seed);
    const auto box = extents(strokes_around(region));
    std::uniform_real_distribution<double> x(box->lower.x(), box->upper.x());
    std::uniform_real_distribution<double> y(box->lower.y(), box->upper.y());
    std::vector<Vec2> places;
    while (static_cast<int>(places.size()) < count) {
        const double at = x(random);
        const Vec2 place(at, y(random));
        if (contains(region, place)) {
            places.push_back(place);
        }
    }
    return places;
}

} // namespace millwright::plot
