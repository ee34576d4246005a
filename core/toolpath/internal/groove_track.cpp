#include "core/toolpath/internal/groove_track.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/toolpath/contact_shape.h"
#include "core/toolpath/internal/contact_point.h"
#include "core/toolpath/tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {

namespace {

Vec3 axis_at(const Covering& of, const Vec3& normal, const Vec3& feed, double along) {
    return of.machine.rotary_axes().empty() ? of.machine.description().tool_axis
                                            : leaning_axis(of.tool.lean, normal, feed, along);
}

double curvature_of_groove(const Covering& of, const Vec3& normal, const Vec3& feed, double along) {
    constexpr double sharpest = 1e9; // 1/mm: of an edge
    const Vec3 axis = axis_at(of, normal, feed, along);
    const double radius = effective_radius(contact_shape(*of.tool.cutter, normal, axis), normal, feed);
    return std::isinf(radius) ? 0.0 : radius > 1.0 / sharpest ? 1.0 / radius : sharpest;
}

/// The share of the way from a to b that is nearest to `point`.
double share_along(const Vec3& a, const Vec3& b, const Vec3& point) {
    const Vec3 way = b - a;
    const double squared = way.squaredNorm();
    return squared > 0.0 ? std::clamp((point - a).dot(way) / squared, 0.0, 1.0) : 0.0;
}

} // namespace

Vec2 uv_of(grid::TrackDirection direction, double along, double across) {
    return direction == grid::TrackDirection::along_v ? Vec2(across, along) : Vec2(along, across);
}

GrooveTrack::GrooveTrack(const Covering& of, const Across& nodes, int columns_per_node, bool forward)
    : forward_(forward) {
    const std::size_t count = (nodes.size() - 1) * static_cast<std::size_t>(columns_per_node) + 1;
    columns_.reserve(count);
    for (std::size_t n = 0; n < count; ++n) {
        columns_.push_back(column_at(of, nodes, n, columns_per_node));
    }
}

GrooveTrack::Column
GrooveTrack::column_at(const Covering& of, const Across& nodes, std::size_t n, int per_node) const {
    const auto each = static_cast<std::size_t>(per_node);
    const std::size_t last = nodes.size() - 1;
    const double step = 1.0 / static_cast<double>(last * each);
    const std::size_t from = std::min(n / each, last - 1);
    const auto slope = [&](std::size_t node) { // in columns
        return (nodes[node + 1] - nodes[node]) / static_cast<double>(per_node);
    };
    Column column;
    column.along = std::min(1.0, static_cast<double>(n) * step);
    column.across = mix(
        nodes[from], nodes[from + 1], static_cast<double>(n - from * each) / static_cast<double>(per_node));
    const Vec2 uv = place_with_normal(of.patch, of.outline, uv_of(of.direction, column.along, column.across));
    const geometry::SurfaceDerivatives d = of.patch.derivatives(uv.x(), uv.y());
    const bool along_v = of.direction == grid::TrackDirection::along_v;
    const Vec3& s_along = along_v ? d.dv : d.du;
    const Vec3& s_across = along_v ? d.du : d.dv;
    const bool at_node = n % each == 0 && n > 0 && n < last * each;
    column.contact = d.position;
    column.normal = contact_point(of.patch, uv, of.flipped).normal;
    column.after = step * s_along + slope(from) * s_across;
    column.before = at_node ? Vec3(step * s_along + slope(from - 1) * s_across) : column.after;
    const Vec3 feed = (column.before + column.after) * (forward_ ? 1.0 : -1.0);
    if (!(feed.squaredNorm() > 0.0)) {
        throw Error(fmt::format("the track has no direction at u = {:.6g}, v = {:.6g}", uv.x(), uv.y()));
    }
    column.curvature = curvature_of_groove(of, column.normal, feed.normalized(), column.along);
    return column;
}

/// Hermite's cubic: chords would be off by more than the heights that are measured.
GrooveTrack::Spot GrooveTrack::spot(std::size_t column, double t) const {
    const Column& a = columns_[column];
    const Column& b = columns_[column + 1];
    const double s = 1.0 - t;
    Spot found;
    found.contact = s * s * ((1.0 + 2.0 * t) * a.contact + t * a.after) +
                    t * t * ((1.0 + 2.0 * s) * b.contact - s * b.before);
    found.normal = (s * a.normal + t * b.normal).normalized();
    found.curvature = mix(a.curvature, b.curvature, t);
    return found;
}

GrooveTrack::Spot GrooveTrack::nearest(const Vec3& point, std::size_t column) const {
    const auto squared = [&](std::size_t n) { return (columns_[n].contact - point).squaredNorm(); };
    const std::size_t last = columns_.size() - 1;
    double least = squared(column);
    for (const bool up : {true, false}) {
        while (column != (up ? last : 0)) {
            const std::size_t next = up ? column + 1 : column - 1;
            const double there = squared(next);
            if (!(there < least)) {
                break;
            }
            least = there;
            column = next;
        }
    }
    Spot best;
    double best_squared = infinity;
    for (std::size_t from = column == 0 ? 0 : column - 1; from <= std::min(column, last - 1); ++from) {
        const double t = share_along(columns_[from].contact, columns_[from + 1].contact, point);
        const Spot here = spot(from, t);
        const double there = (here.contact - point).squaredNorm();
        if (there < best_squared) {
            best_squared = there;
            best = here;
        }
    }
    return best;
}

double GrooveTrack::distance(const Vec3& point, std::size_t column) const {
    return (nearest(point, column).contact - point).norm();
}

/// With k the groove's curvature, w the way from the point to the contact and m the groove's normal, the
/// height t solves k t^2 - 2 (k w.n + m.n) t + k w^2 + 2 w.m = 0, which holds for a flat (k = 0) too.
double GrooveTrack::height(const Vec3& point, const Vec3& normal, std::size_t column) const {
    const Spot groove = nearest(point, column);
    const Vec3 way = groove.contact - point;
    const double q = groove.curvature * way.squaredNorm() + 2.0 * way.dot(groove.normal);
    const double b = groove.curvature * way.dot(normal) + groove.normal.dot(normal);
    const double inside = b * b - groove.curvature * q;
    return b > 0.0 && inside >= 0.0 ? q / (b + std::sqrt(inside)) : infinity;
}

double GrooveTrack::first_step(const Covering& of, std::size_t column, double height) const {
    const Column& here = columns_[column];
    const Vec2 uv = place_with_normal(of.patch, of.outline, uv_of(of.direction, here.along, here.across));
    const geometry::SurfaceDerivatives d = of.patch.derivatives(uv.x(), uv.y());
    const Vec3 way = here.normal.cross(here.before + here.after).normalized();
    const double radius = here.curvature > 0.0 ? 1.0 / here.curvature : infinity;
    const double gap = std::min(step_over(radius, convex_curvature(d, here.normal, way), height),
                                of.tool.cutter->shape().radius);
    const Vec3& s_across = of.direction == grid::TrackDirection::along_v ? d.du : d.dv;
    const double speed = std::abs(s_across.dot(way));
    return speed > gap ? gap / speed : 1.0;
}

} // namespace millwright::toolpath
