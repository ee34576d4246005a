#include "core/hpgl/internal/moves.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/hpgl/internal/letters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::hpgl::internal {

namespace {

void follow_pairs(Run& run, const Given& given, bool relative) {
    for (std::size_t n = 0; n + 1 < given.count(); n += 2) {
        if (relative) {
            run.pen.step(run.units.plotter_step(given.point(n)));
        } else {
            run.pen.go(run.units.plotter(given.point(n)));
        }
        draw_symbol(run);
    }
}

} // namespace

// A refused one leaves the mode as it was.
void plot_absolute(Run& run, const Given& given) {
    follow_pairs(run, given, false);
    run.modes.relative = run.modes.relative && run.pen.refused();
}

void plot_relative(Run& run, const Given& given) {
    follow_pairs(run, given, true);
    run.modes.relative = run.modes.relative || !run.pen.refused();
}

void pen_up(Run& run, const Given& given) {
    run.pen.lift();
    follow_pairs(run, given, run.modes.relative);
}

void pen_down(Run& run, const Given& given) {
    run.pen.lower();
    follow_pairs(run, given, run.modes.relative);
}

namespace {

constexpr double usual_tolerance = 0.005; // mm, between a curve and its chords
constexpr int most_chords = 1000;

/// As many equal steps as keep the chords of a cubic within `tolerance`: a chord over a step h leaves the
/// curve by at most h^2/8 times its greatest second derivative, 6 max|second difference|.
int chord_count(const Vec2& p0, const Vec2& p1, const Vec2& p2, const Vec2& p3, double tolerance) {
    const double bend = 6.0 * std::max((p0 - 2.0 * p1 + p2).norm(), (p1 - 2.0 * p2 + p3).norm());
    return std::clamp(
        static_cast<int>(std::ceil(std::sqrt(std::min(bend / (8.0 * tolerance), 1e9)))), 1, most_chords);
}

void curve(Run& run, const Vec2& p1, const Vec2& p2, const Vec2& p3) {
    const Vec2 p0 = run.at();
    for (const Vec2& p : {p1, p2, p3}) {
        if (!run.pen.is_near(run.units.plotter(p))) { // or a point far away would bend the curve unseen
            return;
        }
    }
    const Vec2 unit(run.settings.unit.x, run.settings.unit.y);
    const auto mm = [&](const Vec2& p) { return Vec2(run.units.plotter(p).cwiseProduct(unit)); };
    const int count =
        chord_count(mm(p0), mm(p1), mm(p2), mm(p3), run.settings.arc_tolerance.value_or(usual_tolerance));
    for (int n = 1; n <= count; ++n) {
        const double t = static_cast<double>(n) / count;
        const double s = 1.0 - t;
        const Vec2 point = s * s * s * p0 + 3.0 * s * s * t * p1 + 3.0 * s * t * t * p2 + t * t * t * p3;
        const Vec2 to = run.units.plotter(n == count ? p3 : point);
        if (run.pen.down()) {
            run.pen.draw(to);
        } else {
            run.pen.place(to);
        }
    }
}

} // namespace

void bezier_absolute(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    for (std::size_t n = 0; n < given.count(); n += 6) {
        curve(run, given.point(n), given.point(n + 2), given.point(n + 4));
    }
}

void bezier_relative(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    for (std::size_t n = 0; n < given.count(); n += 6) {
        const Vec2 start = run.at();
        curve(run, start + given.point(n), start + given.point(n + 2), start + given.point(n + 4));
    }
}

namespace {

constexpr double usual_chord_deg = 5.0;
constexpr double least_chord_deg = 0.05; // a circle of 10 m has then chords of 9 mm, which leave it by 1 um
constexpr double most_sweep_deg = 32767.0;

/// The angle of a chord that leaves a circle of `radius` by `deviation`.
double chord_of_deviation(double radius, double deviation) {
    const double ratio = std::clamp(1.0 - deviation / radius, -1.0, 1.0);
    return to_degrees(2.0 * std::acos(ratio));
}

Vec2 turned_by(const Vec2& v, double deg) {
    const double c = std::cos(from_degrees(deg));
    const double s = std::sin(from_degrees(deg));
    return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

double radius_in_mm(const Run& run, double radius) {
    const Vec2 unit(run.settings.unit.x, run.settings.unit.y);
    const double x = run.units.plotter_step({radius, 0.0}).cwiseProduct(unit).norm();
    const double y = run.units.plotter_step({0.0, radius}).cwiseProduct(unit).norm();
    return std::max(x, y);
}

double chord_deg(const Run& run, double radius, double chord) {
    double deg = run.modes.chord_by_deviation ? chord_of_deviation(radius, std::abs(chord)) : std::abs(chord);
    deg = exactly_equal(deg, 0.0) ? usual_chord_deg : deg;
    if (run.settings.arc_tolerance) {
        deg = std::min(deg, chord_of_deviation(radius_in_mm(run, radius), *run.settings.arc_tolerance));
    }
    return std::clamp(deg, least_chord_deg, 180.0);
}

void follow_points(Run& run, const std::vector<Vec2>& points) {
    for (const Vec2& point : points) {
        if (run.pen.down()) {
            run.pen.draw(run.units.plotter(point));
        } else {
            run.pen.place(run.units.plotter(point));
        }
    }
}

void arc(Run& run, const Vec2& centre, double sweep_deg, double chord) {
    if (run.refuses_if_lost()) {
        return;
    }
    follow_points(run, arc_points(run, centre, run.at(), sweep_deg, chord));
}

/// The arc from the pen through `middle` to `end`; the straight line where the three are on one.
void three_point_arc(Run& run, const Vec2& middle, const Vec2& end, double chord) {
    if (run.refuses_if_lost()) {
        return;
    }
    const Vec2 start = run.at();
    const Vec2 m = middle - start;
    const Vec2 e = end - start;
    const double cross = m.x() * e.y() - m.y() * e.x();
    constexpr double nearly_straight = 1e-9; // sine of the angle at the start
    if (!(std::abs(cross) > nearly_straight * m.norm() * e.norm())) {
        follow_points(run, {end});
        return;
    }
    // Centre of the circle through 0, m and e.
    const double mm = m.squaredNorm();
    const double ee = e.squaredNorm();
    const Vec2 centre = start + Vec2(e.y() * mm - m.y() * ee, m.x() * ee - e.x() * mm) / (2.0 * cross);
    const auto angle = [&](const Vec2& p) { return std::atan2(p.y() - centre.y(), p.x() - centre.x()); };
    double sweep = to_degrees(angle(end) - angle(start));
    if (cross > 0.0 && sweep <= 0.0) {
        sweep += 360.0;
    } else if (cross < 0.0 && sweep >= 0.0) {
        sweep -= 360.0;
    }
    std::vector<Vec2> points = arc_points(run, centre, start, sweep, chord);
    if (points.empty()) {
        return;
    }
    points.back() = end;
    follow_points(run, points);
}

} // namespace

double usual_chord(const Run& run) {
    return run.modes.chord_by_deviation ? 0.0 : usual_chord_deg;
}

std::vector<Vec2>
arc_points(Run& run, const Vec2& centre, const Vec2& start, double sweep_deg, double chord) {
    if (!(std::abs(sweep_deg) <= most_sweep_deg)) {
        run.refuse(
            fmt::format("the arc angle of {} degrees exceeds the limit of {}", sweep_deg, most_sweep_deg));
        return {};
    }
    const Vec2 spoke = start - centre;
    const double radius = spoke.norm();
    if (!(radius > 0.0)) {
        run.refuse("an arc has no radius");
        return {};
    }
    constexpr double slack = 1e-9; // so that 90 degrees are 18 chords of 5 and not 19
    const int count =
        std::max(1, static_cast<int>(std::ceil(std::abs(sweep_deg) / chord_deg(run, radius, chord) - slack)));
    std::vector<Vec2> points;
    points.reserve(static_cast<std::size_t>(count));
    for (int n = 1; n <= count; ++n) {
        points.push_back(centre + turned_by(spoke, sweep_deg * n / count));
    }
    return points;
}

void arc_absolute(Run& run, const Given& given) {
    arc(run, given.point(0), given[2], given.value(3, usual_chord(run)));
}

void arc_relative(Run& run, const Given& given) {
    arc(run, run.at() + given.point(0), given[2], given.value(3, usual_chord(run)));
}

void three_point_arc_absolute(Run& run, const Given& given) {
    three_point_arc(run, given.point(0), given.point(2), given.value(4, usual_chord(run)));
}

void three_point_arc_relative(Run& run, const Given& given) {
    const Vec2 at = run.at();
    three_point_arc(run, at + given.point(0), at + given.point(2), given.value(4, usual_chord(run)));
}

void circle(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    const Vec2 centre = run.at();
    const Vec2 back = run.pen.at();
    const Vec2 start = centre + Vec2(given[0], 0.0);
    std::vector<Vec2> points = {start}; // a dot, which plotters make of a circle without a radius
    if (start != centre) {
        points = arc_points(run, centre, start, 360.0, given.value(1, usual_chord(run)));
        if (points.empty()) {
            return;
        }
        points.back() = start;
    }
    if (run.pen.in_polygon()) {
        run.pen.next_outline();
    }
    run.pen.place(run.units.plotter(start));
    for (const Vec2& point : points) {
        run.pen.draw(run.units.plotter(point));
    }
    if (run.pen.in_polygon()) {
        run.pen.next_outline();
    }
    run.pen.place(back);
}

void chord_mode(Run& run, const Given& given) {
    run.modes.chord_by_deviation = given.value(0, 0.0) > 0.0;
}

} // namespace millwright::hpgl::internal
