#include "core/posts/arc_deviation.h"

#include "core/base/numbers.h"
#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::posts {

namespace {

/// In the plane's first, second and third axis.
Vec3 point_of(const PlaneAxes& axes, const kinematics::AxisPositions& positions) {
    return {positions[axes.first], positions[axes.second], axes.third < 0 ? 0.0 : positions[axes.third]};
}

double distance_from_segment(const Vec3& point, const Vec3& a, const Vec3& b) {
    const Vec3 way = b - a;
    const double square = way.squaredNorm();
    const double t = square > 0.0 ? std::clamp((point - a).dot(way) / square, 0.0, 1.0) : 0.0;
    return (point - a - t * way).norm();
}

/// The arc as a control makes it between two points.
class Arc {
public:
    Arc(const Vec2& centre, double sweep, const Vec3& begin, const Vec3& end)
        : centre_(centre), sweep_(sweep), begin_angle_(angle_of(begin)), begin_radius_(radius_of(begin)),
          end_radius_(radius_of(end)), begin_third_(begin.z()), end_third_(end.z()) {}

    [[nodiscard]] Vec3 at(double s) const {
        const double angle = begin_angle_ + s * sweep_;
        const double radius = mix(begin_radius_, end_radius_, s);
        return {centre_.x() + radius * std::cos(angle),
                centre_.y() + radius * std::sin(angle),
                mix(begin_third_, end_third_, s)};
    }

    /// The fraction of the sweep at which `point` lies, next to `near`.
    [[nodiscard]] double fraction(const Vec3& point, double near) const {
        const double turned = angle_of(point) - begin_angle_;
        const double turns = std::round((near * sweep_ - turned) / (2.0 * pi));
        return (turned + 2.0 * pi * turns) / sweep_;
    }

    [[nodiscard]] double distance(const Vec3& point, double near) const {
        const double s = std::clamp(fraction(point, near), 0.0, 1.0);
        return (point - at(s)).norm();
    }

private:
    Vec2 centre_;
    double sweep_, begin_angle_, begin_radius_, end_radius_, begin_third_, end_third_;

    [[nodiscard]] double angle_of(const Vec3& point) const {
        return std::atan2(point.y() - centre_.y(), point.x() - centre_.x());
    }
    [[nodiscard]] double radius_of(const Vec3& point) const {
        return std::hypot(point.x() - centre_.x(), point.y() - centre_.y());
    }
};

/// Between a chord and the part of the arc from fraction s to e.
double chord_deviation(const Arc& arc, const Vec3& a, const Vec3& b, double s, double e) {
    constexpr int samples = 8; // even, so that the middle is one of them
    double largest = 0.0;
    for (int k = 0; k <= samples; ++k) {
        const double t = static_cast<double>(k) / samples;
        const double fraction = mix(s, e, t);
        const Vec3 on_chord = (1.0 - t) * a + t * b;
        largest = std::max(
            {largest, distance_from_segment(arc.at(fraction), a, b), arc.distance(on_chord, fraction)});
    }
    return largest;
}

} // namespace

double
arc_deviation(const program::Program& program, const ProgramWords& program_words, const FittedArc& arc) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const PlaneAxes axes = plane_axes(program.axes, arc.plane);
    std::vector<Vec3> points{point_of(axes, program_words.blocks[static_cast<std::size_t>(arc.first)].from)};
    for (int n = arc.first; n <= arc.last; ++n) {
        points.push_back(point_of(axes, program_words.blocks[static_cast<std::size_t>(n)].to));
    }
    const Arc circle(arc.centre, arc.sweep, points.front(), points.back());
    double largest = 0.0;
    double s = 0.0;
    for (std::size_t k = 1; k < points.size(); ++k) {
        const bool last = k + 1 == points.size();
        const double e = circle.fraction(points[k], s);
        constexpr double same_angle = 1e-6; // of the sweep: rounding of its end
        if (!(e > s) || (last ? std::abs(e - 1.0) > same_angle : e >= 1.0)) {
            return never;
        }
        largest = std::max(largest, chord_deviation(circle, points[k - 1], points[k], s, last ? 1.0 : e));
        s = e;
    }
    return largest;
}

} // namespace millwright::posts
