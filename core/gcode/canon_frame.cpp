#include "core/gcode/canon_frame.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::gcode {

void CanonFrame::command(const Command& command) {
    constexpr double inch = 25.4;
    switch (command.kind) {
    case CommandKind::use_length_units:
        unit_ = command.index == 1 ? inch : 1.0;
        break;
    case CommandKind::set_g5x_offset:
        g5x_ = command.axes.lengths_scaled(unit_);
        break;
    case CommandKind::set_g92_offset:
        g92_ = command.axes.lengths_scaled(unit_);
        break;
    case CommandKind::set_xy_rotation:
        rotation_ = from_degrees(command.value);
        break;
    case CommandKind::use_tool_length_offset:
        tool_ = command.axes.lengths_scaled(unit_);
        break;
    default:
        break;
    }
}

AxisValues CanonFrame::to_machine(const AxisValues& position) const {
    return turned(position.lengths_scaled(unit_) + g92_, rotation_) + g5x_ + tool_;
}

AxisValues CanonFrame::from_machine(const AxisValues& position) const {
    return (turned(position - g5x_ - tool_, -rotation_) - g92_).lengths_scaled(1.0 / unit_);
}

AxisValues CanonFrame::turned(AxisValues values, double angle) {
    const double x = values[Axis::x];
    const double y = values[Axis::y];
    values[Axis::x] = x * std::cos(angle) - y * std::sin(angle);
    values[Axis::y] = x * std::sin(angle) + y * std::cos(angle);
    return values;
}

namespace {

std::pair<Axis, Axis> first_two_axes(Plane plane) {
    switch (plane) {
    case Plane::xz:
        return {Axis::z, Axis::x};
    case Plane::yz:
        return {Axis::y, Axis::z};
    default:
        return {Axis::x, Axis::y};
    }
}

/// The longest angle whose chord stays within `tolerance` of its arc.
double longest_step(double radius, double tolerance) {
    constexpr double most = pi / 4.0;
    const double height = std::min(1.0, tolerance / radius);
    return std::min(most, 2.0 * std::acos(1.0 - height));
}

struct Radii {
    double start = 0.0, end = 0.0;
};

Radii radii_of(const AxisValues& start, const Move& arc) {
    const auto [first, second] = first_two_axes(arc.plane);
    return {std::hypot(start[first] - arc.centre_1, start[second] - arc.centre_2),
            std::hypot(arc.target[first] - arc.centre_1, arc.target[second] - arc.centre_2)};
}

void equal_chords(const AxisValues& start, const Move& arc, double wanted, const ChordSink& sink) {
    expects(wanted <= most_chords, "an arc has a finite number of chords");
    const auto [first, second] = first_two_axes(arc.plane);
    const Radii radii = radii_of(start, arc);
    const double angle = std::atan2(start[second] - arc.centre_2, start[first] - arc.centre_1);
    const int chords = std::max(1, static_cast<int>(wanted));
    for (int k = 1; k < chords; ++k) {
        const double share = static_cast<double>(k) / chords;
        AxisValues at;
        for (std::size_t n = 0; n < axis_count; ++n) {
            at[n] = mix(start[n], arc.target[n], share);
        }
        const double here = mix(radii.start, radii.end, share);
        at[first] = arc.centre_1 + here * std::cos(angle + share * arc.sweep);
        at[second] = arc.centre_2 + here * std::sin(angle + share * arc.sweep);
        sink(at);
    }
    sink(arc.target);
}

/// A rational B-spline, clamped and uniform.
class Spline {
public:
    explicit Spline(const Curve& curve) : curve_(curve), order_(curve.order) {
        expects(order_ >= 2 && order_ <= static_cast<int>(highest_order),
                "a spline has an order that was read");
        expects(std::ssize(curve.points) >= order_, "a spline has as many points as its order");
    }

    [[nodiscard]] int spans() const { return static_cast<int>(curve_.points.size()) - order_ + 1; }

    /// At `t` from 0 to spans(), by de Boor's algorithm.
    [[nodiscard]] std::array<double, 2> at(double t) const {
        const int span = std::clamp(static_cast<int>(t), 0, spans() - 1);
        std::array<std::array<double, 3>, highest_order> p{};
        for (int k = 0; k < order_; ++k) {
            const ControlPoint& c = curve_.points[static_cast<std::size_t>(span + k)];
            p[static_cast<std::size_t>(k)] = {c.x * c.weight, c.y * c.weight, c.weight};
        }
        for (int level = 1; level < order_; ++level) {
            for (int k = order_ - 1; k >= level; --k) {
                const double from = knot(span + k);
                const double to = knot(span + k + order_ - level);
                const double share = (t - from) / (to - from);
                const auto n = static_cast<std::size_t>(k);
                for (std::size_t c = 0; c < 3; ++c) {
                    p[n][c] = mix(p[n - 1][c], p[n][c], share);
                }
            }
        }
        const std::array<double, 3>& last = p[static_cast<std::size_t>(order_ - 1)];
        return {last[0] / last[2], last[1] / last[2]};
    }

private:
    static constexpr std::size_t highest_order = 20; // as the reader takes

    const Curve& curve_;
    int order_;

    [[nodiscard]] double knot(int n) const {
        return static_cast<double>(std::clamp(n - order_ + 1, 0, spans()));
    }
};

double distance_from_chord(const std::array<double, 2>& p,
                           const std::array<double, 2>& a,
                           const std::array<double, 2>& b) {
    const double x = b[0] - a[0];
    const double y = b[1] - a[1];
    const double length = x * x + y * y;
    const double along = length > 0.0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / length : 0.0;
    const double t = std::clamp(along, 0.0, 1.0);
    return std::hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
}

class Halver {
public:
    Halver(const Spline& spline, const AxisValues& start, double tolerance, const ChordSink& sink)
        : spline_(spline), at_(start), tolerance_(tolerance), sink_(sink) {}

    void go(double from, double to, int depth) {
        constexpr int deepest = 16;
        const auto a = spline_.at(from);
        const auto b = spline_.at(to);
        double worst = 0.0;
        for (const double share : {0.25, 0.5, 0.75}) {
            worst = std::max(worst, distance_from_chord(spline_.at(mix(from, to, share)), a, b));
        }
        if (worst <= tolerance_ || depth == deepest) {
            at_[Axis::x] = b[0];
            at_[Axis::y] = b[1];
            sink_(at_);
            return;
        }
        const double middle = (from + to) / 2.0;
        go(from, middle, depth + 1);
        go(middle, to, depth + 1);
    }

private:
    const Spline& spline_;
    AxisValues at_;
    double tolerance_;
    const ChordSink& sink_;
};

} // namespace

double arc_radius(const AxisValues& start, const Move& arc) {
    const Radii radii = radii_of(start, arc);
    return std::max(radii.start, radii.end);
}

double chord_count(const AxisValues& start, const Move& arc, double tolerance) {
    const double step = longest_step(std::max(arc_radius(start, arc), tolerance), tolerance);
    // A tolerance can be too small for the arc's numbers.
    return step > 0.0 ? std::ceil(std::abs(arc.sweep) / step) : std::numeric_limits<double>::infinity();
}

double chord_count_of_length(const AxisValues& start, const Move& arc, double length) {
    constexpr double rounding = 1e-9; // of an arc that is a whole number of chords long
    return std::ceil(std::abs(arc.sweep) * radii_of(start, arc).start / length - rounding);
}

void arc_chords(const AxisValues& start, const Move& arc, double tolerance, const ChordSink& sink) {
    expects(tolerance > 0.0, "a chord tolerance is positive");
    equal_chords(start, arc, chord_count(start, arc, tolerance), sink);
}

void arc_chords_of_length(const AxisValues& start, const Move& arc, double length, const ChordSink& sink) {
    expects(length > 0.0, "a chord has a length");
    equal_chords(start, arc, chord_count_of_length(start, arc, length), sink);
}

void curve_chords(const AxisValues& start, const Curve& curve, double tolerance, const ChordSink& sink) {
    expects(tolerance > 0.0, "a chord tolerance is positive");
    const Spline spline(curve);
    Halver halver(spline, start, tolerance, sink);
    for (int span = 0; span < spline.spans(); ++span) {
        halver.go(span, span + 1, 0);
    }
}

} // namespace millwright::gcode
