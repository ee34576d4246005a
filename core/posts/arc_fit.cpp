#include "core/posts/arc_fit.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
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

namespace {

constexpr int fewest_feeds = 3;
constexpr int most_feeds = 4096;
constexpr double largest_radius = 1000.0; // mm
constexpr double smallest_sweep = from_degrees(1.0);
constexpr double largest_sweep = from_degrees(350.0);           // a whole turn ends where it begins
constexpr double largest_sweep_by_radius = from_degrees(175.0); // beyond it a radius stands for two arcs
constexpr double same_speed = 1e-3;                             // relative: durations are rounded

class Fitter {
public:
    Fitter(const program::Program& program,
           const ProgramWords& program_words,
           const PostFormat& format,
           double tolerance)
        : program_(program), program_words_(program_words), format_(format), tolerance_(tolerance) {
        const ArcFormat& arcs = *format.arcs;
        for (const auto& [plane, allowed] : {std::pair{gcode::Plane::xy, arcs.xy},
                                             std::pair{gcode::Plane::xz, arcs.zx},
                                             std::pair{gcode::Plane::yz, arcs.yz}}) {
            const PlaneAxes axes = plane_axes(program.axes, plane);
            if (allowed && axes.first >= 0 && axes.second >= 0) {
                planes_.push_back(plane);
            }
        }
    }

    std::vector<FittedArc> fit() const {
        std::vector<FittedArc> arcs;
        for (int first = 0; first < program_.block_count();) {
            const int end = end_of_run(first);
            if (const std::optional<FittedArc> arc = longest(first, end)) {
                first = arc->last + 1;
                arcs.push_back(*arc);
            } else {
                ++first;
            }
        }
        return arcs;
    }

private:
    const program::Program& program_;
    const ProgramWords& program_words_;
    const PostFormat& format_;
    double tolerance_;
    std::vector<gcode::Plane> planes_;

    [[nodiscard]] const program::Block& block(int n) const {
        return program_.blocks[static_cast<std::size_t>(n)];
    }
    [[nodiscard]] const BlockWords& words(int n) const {
        return program_words_.blocks[static_cast<std::size_t>(n)];
    }

    [[nodiscard]] double speed(int n) const {
        const FeedWay way = feed_way(program_.axes, words(n).from, words(n).to);
        return way.angular ? 0.0 : way.length / block(n).duration;
    }

    /// Behind the feeds from `first` on that may share an arc as far as speed, role and other axes go.
    [[nodiscard]] int end_of_run(int first) const {
        const program::Block& begin = block(first);
        int end = first;
        while (end < program_.block_count() && end - first < most_feeds) {
            const program::Block& now = block(end);
            const bool alike = now.kind == program::BlockKind::feed && !now.programmed_speed &&
                               now.role == begin.role && others_still(end) &&
                               std::abs(speed(end) - speed(first)) <= same_speed * speed(first);
            if (!alike) {
                break;
            }
            ++end;
        }
        return end;
    }

    [[nodiscard]] bool others_still(int n) const {
        for (std::size_t axis = 0; axis < program_.axes.size(); ++axis) {
            const bool turns =
                std::string_view("XYZ").find(program_.axes[axis].letter) == std::string_view::npos;
            const auto k = static_cast<Eigen::Index>(axis);
            if (turns && !exactly_equal(words(n).from[k], words(n).to[k])) {
                return false;
            }
        }
        return true;
    }

    /// By doubling the number of feeds while an arc fits, then halving the rest.
    [[nodiscard]] std::optional<FittedArc> longest(int first, int end) const {
        for (const gcode::Plane plane : planes_) {
            std::optional<FittedArc> best;
            int fits = fewest_feeds - 1;
            int too_many = end - first + 1;
            for (int count = fewest_feeds; count < too_many;) {
                if (auto arc = arc_over(plane, first, first + count - 1)) {
                    best = arc;
                    fits = count;
                    count = std::min(2 * count, too_many - 1) > fits ? std::min(2 * count, too_many - 1)
                                                                     : too_many;
                } else {
                    too_many = count;
                    break;
                }
            }
            while (best && too_many - fits > 1) {
                const int count = (fits + too_many) / 2;
                if (auto arc = arc_over(plane, first, first + count - 1)) {
                    best = arc;
                    fits = count;
                } else {
                    too_many = count;
                }
            }
            if (best) {
                return best;
            }
        }
        return std::nullopt;
    }

    /// The arc through begin, middle and end, if it is near enough everywhere.
    [[nodiscard]] std::optional<FittedArc> arc_over(gcode::Plane plane, int first, int last) const {
        const PlaneAxes axes = plane_axes(program_.axes, plane);
        const auto in_plane = [&](const kinematics::AxisPositions& q) {
            return Vec2(q[axes.first], q[axes.second]);
        };
        const Vec2 begin = in_plane(words(first).from);
        const Vec2 end = in_plane(words(last).to);
        const std::optional<Vec2> centre = centre_of(begin, in_plane(words((first + last) / 2).to), end);
        if (!centre || !rises_as_allowed(axes, first, last)) {
            return std::nullopt;
        }
        FittedArc arc{first, last, plane, as_written(*centre, begin), 0.0, 0.0};
        arc.radius = (begin - arc.centre).norm();
        Vec2 arm = begin - arc.centre;
        for (int n = first; n <= last; ++n) {
            const Vec2 next = in_plane(words(n).to) - arc.centre;
            arc.sweep += std::atan2(arm.x() * next.y() - arm.y() * next.x(), arm.dot(next));
            arm = next;
        }
        if (!sound(arc) || !(arc_deviation(program_, program_words_, arc) <= tolerance_)) {
            return std::nullopt;
        }
        return arc;
    }

    [[nodiscard]] static std::optional<Vec2> centre_of(const Vec2& a, const Vec2& b, const Vec2& c) {
        const Vec2 u = b - a;
        const Vec2 v = c - a;
        const double area = 2.0 * (u.x() * v.y() - u.y() * v.x());
        constexpr double flattest = 1e-9; // of the lengths: straight
        if (!(std::abs(area) > flattest * u.norm() * v.norm())) {
            return std::nullopt;
        }
        const double uu = u.squaredNorm();
        const double vv = v.squaredNorm();
        return a + Vec2(v.y() * uu - u.y() * vv, u.x() * vv - v.x() * uu) / area;
    }

    /// Rounded as the text will say it.
    [[nodiscard]] Vec2 as_written(const Vec2& centre, const Vec2& begin) const {
        if (format_.arcs->centre == ArcCentre::radius) {
            return centre;
        }
        const bool relative = format_.arcs->centre == ArcCentre::relative;
        const double unit = format_.length_unit();
        const Vec2 base = relative ? begin : Vec2::Zero();
        const auto rounded = [&](double value) {
            return format_.numbers.length.rounded(value / unit) * unit;
        };
        const Vec2 off = centre - base;
        return base + Vec2(rounded(off.x()), rounded(off.y()));
    }

    [[nodiscard]] bool rises_as_allowed(const PlaneAxes& axes, int first, int last) const {
        const bool still =
            axes.third < 0 || exactly_equal(words(first).from[axes.third], words(last).to[axes.third]);
        return still || format_.arcs->helical;
    }

    [[nodiscard]] bool sound(const FittedArc& arc) const {
        constexpr double digits_of_a_radius = 10.0;
        const double smallest_radius =
            digits_of_a_radius * format_.numbers.length.digit() * format_.length_unit();
        const bool by_radius = format_.arcs->centre == ArcCentre::radius;
        return arc.radius >= smallest_radius && arc.radius <= largest_radius &&
               std::abs(arc.sweep) >= smallest_sweep &&
               std::abs(arc.sweep) <= (by_radius ? largest_sweep_by_radius : largest_sweep);
    }
};

} // namespace

std::vector<FittedArc> fit_arcs(const program::Program& program,
                                const ProgramWords& program_words,
                                const PostFormat& format,
                                double tolerance) {
    expects(tolerance > 0.0, "the tolerance of arcs is positive");
    if (!format.arcs) {
        throw Error(
            fmt::format("programs for {} cannot contain arcs", format.name), {}, "omit the arc tolerance");
    }
    return Fitter(program, program_words, format, tolerance).fit();
}

} // namespace millwright::posts
