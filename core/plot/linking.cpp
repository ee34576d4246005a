#include "core/plot/linking.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::plot {
namespace {

/// Where the line a + t (b - a) meets the edge from c to d, if it does between its ends.
std::optional<double> crossing(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 u = b - a;
    const Vec2 v = d - c;
    const Vec2 w = c - a;
    const double cross = u.x() * v.y() - u.y() * v.x();
    constexpr double nearly_parallel = 1e-12;
    if (!(std::abs(cross) > nearly_parallel * u.norm() * v.norm())) {
        return std::nullopt;
    }
    const double t = (w.x() * v.y() - w.y() * v.x()) / cross;
    const double s = (w.x() * u.y() - w.y() * u.x()) / cross;
    return t > 0.0 && t < 1.0 && s >= 0.0 && s <= 1.0 ? std::optional(t) : std::nullopt;
}

bool near_edge(const Region& region, const Vec2& p, double tolerance) {
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Vec2& a = ring[n];
            const Vec2 ab = ring[(n + 1) % ring.size()] - a;
            const double t =
                ab.squaredNorm() > 0.0 ? std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0) : 0.0;
            if ((a + t * ab - p).norm() <= tolerance) {
                return true;
            }
        }
    }
    return false;
}

} // namespace

bool stays_inside(const Region& region, const Vec2& a, const Vec2& b) {
    constexpr double on_edge = 1e-6; // mm: hatch lines end on the outline
    std::vector<double> cuts = {0.0, 1.0};
    for (const Ring& ring : region) {
        for (std::size_t n = 0; n < ring.size(); ++n) {
            if (const auto t = crossing(a, b, ring[n], ring[(n + 1) % ring.size()])) {
                cuts.push_back(*t);
            }
        }
    }
    std::ranges::sort(cuts);
    for (std::size_t n = 1; n < cuts.size(); ++n) {
        const Vec2 middle = a + 0.5 * (cuts[n - 1] + cuts[n]) * (b - a);
        if (!contains(region, middle) && !near_edge(region, middle, on_edge)) {
            return false;
        }
    }
    return true;
}

Region enclosed(const Strokes& strokes, double tolerance) {
    Region region;
    for (const Stroke& stroke : strokes) {
        const bool closed =
            stroke.points.size() > 3 && (stroke.points.front() - stroke.points.back()).norm() < tolerance;
        if (closed) {
            region.emplace_back(stroke.points.begin(), stroke.points.end() - 1);
        }
    }
    return region;
}

Linked link(const Strokes& strokes, const LinkSettings& settings) {
    if (!(settings.distance >= 0.0)) {
        throw Error("the distance of links has to be 0 mm or more");
    }
    Linked linked;
    for (const Stroke& stroke : strokes) {
        Stroke* last = linked.strokes.empty() ? nullptr : &linked.strokes.back();
        const bool lines = last != nullptr && last->points.size() > 1 && stroke.points.size() > 1;
        const double gap = lines ? (stroke.points.front() - last->points.back()).norm() : 0.0;
        const bool near = lines && last->pen == stroke.pen && gap < settings.distance;
        if (near && settings.inside &&
            !stays_inside(*settings.inside, last->points.back(), stroke.points.front())) {
            ++linked.refused;
        } else if (near) {
            const auto from = stroke.points.begin() + (gap > 0.0 ? 0 : 1);
            last->points.insert(last->points.end(), from, stroke.points.end());
            ++linked.links;
            linked.link_length += gap;
            continue;
        }
        linked.strokes.push_back(stroke);
    }
    return linked;
}

} // namespace millwright::plot
