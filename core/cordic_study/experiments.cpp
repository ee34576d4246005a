#include "core/cordic_study/experiments.h"

#include "core/base/units.h"
#include "core/cordic/interpolation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace millwright::cordic {
namespace {

using Binary64 = FloatArithmetic<double>;

constexpr double e5_speed = 0.5;        // V of E5
constexpr double e5_acceleration = 0.3; // A of E5
constexpr double converges_deg = 97.0;

constexpr Kernel<Binary64> thesis_kernel(Binary64(), thesis_sequence());

struct PlanePoint {
    double x = 0.0, y = 0.0;
};

PlanePoint on_circle(double deg) {
    return {std::cos(from_degrees(deg)), std::sin(from_degrees(deg))};
}

std::vector<double> steps(double from, double to, double by) {
    std::vector<double> made;
    for (int n = 0; from + n * by <= to + 0.5 * by; ++n) {
        made.push_back(from + n * by);
    }
    return made;
}

/// One series of dots for each pair of flags.
std::vector<Series> by_flags() {
    std::vector<Series> made;
    for (const int flags : {0, 1, 2, 3}) {
        made.push_back({.label = "f1 = " + std::to_string(flags % 2) + ", f2 = " + std::to_string(flags / 2),
                        .mark = Mark::dots});
    }
    return made;
}

void fold_everything(Experiments& all) {
    bool overflow = false;
    std::vector<Series> folded = by_flags();
    std::vector<Series> unfolded = by_flags();
    double outside = 0.0;
    double worst = 0.0;
    for (const double deg : steps(-180.0, 180.0, 0.1)) {
        const PlanePoint in = on_circle(deg);
        const auto out = pre(Binary64(), in.x, in.y, overflow);
        const std::size_t flags = (out.f1 ? 1U : 0U) + (out.f2 ? 2U : 0U);
        const double angle = to_degrees(std::atan2(out.y, out.x));
        folded[flags].x.push_back(deg);
        folded[flags].y.push_back(angle);
        outside = std::max(outside, std::abs(angle) - 90.0);
        const auto back = post(Binary64(), out, overflow);
        unfolded[flags].x.push_back(angle);
        unfolded[flags].y.push_back(to_degrees(std::atan2(back.y, back.x)));
        worst = std::max({worst, std::abs(back.x - in.x), std::abs(back.y - in.y)});
    }
    all.pictures.push_back({"e1-pre.svg",
                            to_svg(Chart{.title = "E1: PreCORDIC folds every direction into ±90°",
                                         .x_label = "direction before, degrees",
                                         .y_label = "direction after, degrees",
                                         .series = folded})});
    all.pictures.push_back({"e2-post.svg",
                            to_svg(Chart{.title = "E2: PostCORDIC restores each direction",
                                         .x_label = "direction after PreCORDIC, degrees",
                                         .y_label = "direction after PostCORDIC, degrees",
                                         .series = unfolded})});
    all.findings.push_back(
        {"E1", "direction beyond 90 degrees after PreCORDIC, degrees", std::max(outside, 0.0)});
    all.findings.push_back({"E2", "PostCORDIC after PreCORDIC against the vector before", worst});
}

double rotation_error(double theta_deg, double z_deg) {
    bool overflow = false;
    const PlanePoint in = on_circle(theta_deg);
    const double z = from_degrees(z_deg);
    const auto out = thesis_kernel.rotated({in.x, in.y, z}, overflow);
    return std::max(std::abs(out.x - (in.x * std::cos(z) - in.y * std::sin(z))),
                    std::abs(out.y - (in.y * std::cos(z) + in.x * std::sin(z))));
}

void rotate_everything(Experiments& all) {
    HeatMap map{.title = "E3: rotation",
                .x_label = "direction of the vector, degrees",
                .y_label = "angle z, degrees",
                .value_label = "error",
                .x = steps(-180.0, 180.0, 5.0),
                .y = steps(-180.0, 180.0, 2.5)};
    for (const double z : map.y) {
        for (const double theta : map.x) {
            map.values.push_back(rotation_error(theta, z));
        }
    }
    double inside = 0.0;
    double beyond = 0.0;
    for (const double z : steps(-180.0, 180.0, 0.5)) {
        for (const double theta : steps(-180.0, 180.0, 5.0)) {
            double& worst = std::abs(z) <= converges_deg ? inside : beyond;
            worst = std::max(worst, rotation_error(theta, z));
        }
    }
    all.pictures.push_back({"e3-rotation.svg", to_svg(map)});
    all.findings.push_back({"E3", "rotation of a unit vector, angle within 97 degrees", inside});
    all.findings.push_back({"E3", "the same beyond, where it cannot converge", beyond});
}

void vector_everything(Experiments& all) {
    bool overflow = false;
    Chart lengths{.title = "E4: length by vectoring", .x_label = "direction, degrees", .y_label = "error"};
    double worst = 0.0;
    for (const double r : {20.0, 40.0, 60.0, 80.0, 100.0}) {
        Series series{.label = "r = " + std::to_string(static_cast<int>(r))};
        for (const double deg : steps(-converges_deg, converges_deg, 0.5)) {
            const PlanePoint in = on_circle(deg);
            const double error = thesis_kernel.vectored({r * in.x, r * in.y, 0.0}, overflow).x / r - 1.0;
            series.x.push_back(deg);
            series.y.push_back(r * error); // else all of them would lie on one another
            worst = std::max(worst, std::abs(error));
        }
        lengths.series.push_back(std::move(series));
    }
    all.pictures.push_back({"e4-length.svg", to_svg(lengths)});
    all.findings.push_back({"E4", "length by vectoring within 97 degrees, relative", worst});

    Series series;
    worst = 0.0;
    for (const double deg : steps(-180.0, 180.0, 0.5)) {
        const PlanePoint in = on_circle(deg);
        const double error =
            std::abs(thesis_kernel.vectored({in.x, in.y, 0.0}, overflow).z - std::atan2(in.y, in.x));
        series.x.push_back(deg);
        series.y.push_back(error);
        worst = std::abs(deg) <= converges_deg ? std::max(worst, error) : worst;
    }
    all.pictures.push_back({"e4-angle.svg",
                            to_svg(Chart{.title = "E4: direction by vectoring, without PreCORDIC",
                                         .x_label = "direction, degrees",
                                         .y_label = "error, rad",
                                         .series = {series},
                                         .logarithmic = true})});
    all.findings.push_back({"E4", "direction by vectoring within 97 degrees, rad", worst});
}

/// As the thesis most likely has it in its figure 5.6. On a finer grid it grows without bound: beside an axis
/// the speed across it vanishes, and its error does not.
double e5_relative() {
    constexpr int directions = 51;
    constexpr double vanishing = 1e-9; // of V: along an axis the other one has no speed to compare with
    bool overflow = false;
    double worst = 0.0;
    for (int n = 0; n < directions; ++n) {
        const PlanePoint to = on_circle(-180.0 + 360.0 * n / (directions - 1));
        const auto set =
            line_set_point(thesis_kernel, to.x, to.y, 0.0, 0.0, e5_speed, e5_acceleration, overflow);
        const double length = std::hypot(to.x, to.y);
        const std::array<std::pair<double, double>, 2> axes{
            {{set.vx, to.x / length}, {set.vy, to.y / length}}};
        for (const auto& [found, share] : axes) {
            const double exact = e5_speed * share;
            worst = std::abs(share) > vanishing
                        ? std::max(worst, 100.0 * std::abs(found - exact) / std::abs(exact))
                        : worst;
        }
    }
    return worst;
}

void all_directions(Experiments& all) {
    bool overflow = false;
    Chart values{.title = "E5: G01 in every direction, V = 0.5, A = 0.3",
                 .x_label = "direction, degrees",
                 .y_label = "axis speed and acceleration",
                 .series = {{.label = "Vx"}, {.label = "Vy"}, {.label = "Ax"}, {.label = "Ay"}}};
    Chart errors{.title = "E5: error of the axis speeds, percent of V",
                 .x_label = "direction, degrees",
                 .y_label = "error, percent",
                 .series = {{.label = "Vx"}, {.label = "Vy"}}};
    double worst_speed = 0.0;
    double worst_acceleration = 0.0;
    for (const double deg : steps(-180.0, 180.0, 0.1)) {
        const PlanePoint to = on_circle(deg);
        const auto set =
            line_set_point(thesis_kernel, to.x, to.y, 0.0, 0.0, e5_speed, e5_acceleration, overflow);
        const double length = std::hypot(to.x, to.y);
        const std::array<double, 4> found = {set.vx, set.vy, set.ax, set.ay};
        for (std::size_t n = 0; n < found.size(); ++n) {
            values.series[n].x.push_back(deg);
            values.series[n].y.push_back(found[n]);
        }
        const std::array<double, 2> error = {set.vx - e5_speed * to.x / length,
                                             set.vy - e5_speed * to.y / length};
        for (std::size_t n = 0; n < error.size(); ++n) {
            errors.series[n].x.push_back(deg);
            errors.series[n].y.push_back(100.0 * error[n] / e5_speed);
            worst_speed = std::max(worst_speed, std::abs(error[n]));
        }
        worst_acceleration = std::max({worst_acceleration,
                                       std::abs(set.ax - e5_acceleration * to.x / length),
                                       std::abs(set.ay - e5_acceleration * to.y / length)});
    }
    all.pictures.push_back({"e5-values.svg", to_svg(values)});
    all.pictures.push_back({"e5-errors.svg", to_svg(errors)});
    all.findings.push_back({"E5", "axis speed of G01, V = 0.5", worst_speed});
    all.findings.push_back({"E5", "axis acceleration of G01, A = 0.3", worst_acceleration});
    all.findings.push_back(
        {"E5", "each axis speed of G01 in percent of itself, 51 directions", e5_relative()});
}

struct Arc {
    PlanePoint centre, start;
    double sweep = 0.0; ///< rad, > 0 counter-clockwise
    int chords = 0;
};

/// The points behind each chord.
std::vector<PlanePoint> points_of(const Arc& arc) {
    bool overflow = false;
    std::vector<PlanePoint> points;
    PlanePoint at = arc.start;
    for (int n = 0; n < arc.chords; ++n) {
        const auto next = arc_point(
            thesis_kernel, arc.centre.x, arc.centre.y, at.x, at.y, arc.sweep / arc.chords, overflow);
        at = {next.x, next.y};
        points.push_back(at);
    }
    return points;
}

/// How far each point is from where it belongs.
struct ArcErrors {
    std::vector<double> chord, x, y, radius, distance; ///< signed but the last; of the n-th chord, from 1

    [[nodiscard]] static double largest(const std::vector<double>& errors) {
        double worst = 0.0;
        for (const double error : errors) {
            worst = std::max(worst, std::abs(error));
        }
        return worst;
    }
};

ArcErrors errors_of(const Arc& arc, const std::vector<PlanePoint>& points) {
    ArcErrors errors;
    const double dx = arc.start.x - arc.centre.x;
    const double dy = arc.start.y - arc.centre.y;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const auto chord = static_cast<double>(k + 1);
        const double theta = arc.sweep * chord / arc.chords;
        const double x = points[k].x - (arc.centre.x + dx * std::cos(theta) - dy * std::sin(theta));
        const double y = points[k].y - (arc.centre.y + dx * std::sin(theta) + dy * std::cos(theta));
        errors.chord.push_back(chord);
        errors.x.push_back(x);
        errors.y.push_back(y);
        errors.radius.push_back(std::hypot(points[k].x - arc.centre.x, points[k].y - arc.centre.y) -
                                std::hypot(dx, dy));
        errors.distance.push_back(std::hypot(x, y));
    }
    return errors;
}

void add_points(Series& series, const std::vector<PlanePoint>& points) {
    for (const PlanePoint& point : points) {
        series.x.push_back(point.x);
        series.y.push_back(point.y);
    }
}

void one_arc(Experiments& all) {
    Chart chart{.title = "E6: an arc of 50 chords, 3/2 pi about (5, 10)",
                .x_label = "X",
                .y_label = "Y",
                .series = {{.label = "counter-clockwise", .mark = Mark::dots},
                           {.label = "clockwise", .mark = Mark::dots}},
                .same_scale = true};
    double worst_x = 0.0;
    double worst_y = 0.0;
    double worst_radius = 0.0;
    for (const int sense : {1, -1}) {
        const Arc arc{.centre = {5.0, 10.0}, .start = {10.0, 10.0}, .sweep = sense * 1.5 * pi, .chords = 50};
        const auto points = points_of(arc);
        const ArcErrors errors = errors_of(arc, points);
        add_points(chart.series[sense > 0 ? 0 : 1], points);
        worst_x = std::max(worst_x, ArcErrors::largest(errors.x));
        worst_y = std::max(worst_y, ArcErrors::largest(errors.y));
        worst_radius = std::max(worst_radius, ArcErrors::largest(errors.radius));
        if (sense > 0) {
            all.pictures.push_back(
                {"e6-errors.svg",
                 to_svg(Chart{.title = "E6: error of each point, counter-clockwise",
                              .x_label = "chord",
                              .y_label = "error",
                              .series = {{.label = "X", .x = errors.chord, .y = errors.x},
                                         {.label = "Y", .x = errors.chord, .y = errors.y},
                                         {.label = "radius", .x = errors.chord, .y = errors.radius}}})});
        }
    }
    all.pictures.push_back({"e6-arc.svg", to_svg(chart)});
    all.findings.push_back({"E6", "X of the arc's points", worst_x});
    all.findings.push_back({"E6", "Y of the arc's points", worst_y});
    all.findings.push_back({"E6", "radius of the arc's points", worst_radius});
}

void whole_program(Experiments& all) {
    constexpr int chords = 25;
    const Arc first{.centre = {4.0, 6.0}, .start = {6.0, 6.0}, .sweep = -0.5 * pi, .chords = chords};
    const Arc second{.centre = {2.0, 2.0}, .start = {2.0, 4.0}, .sweep = 0.5 * pi, .chords = chords};
    const auto first_points = points_of(first);
    const auto second_points = points_of(second);
    Series path{.mark = Mark::line};
    add_points(path, {{0.0, 0.0}, {8.0, 0.0}, {8.0, 6.0}, {6.0, 6.0}});
    add_points(path, first_points);
    add_points(path, {{2.0, 4.0}});
    add_points(path, second_points);
    add_points(path, {{0.0, 1.0}, {0.0, 0.0}});
    all.pictures.push_back({"e7-program.svg",
                            to_svg(Chart{.title = "E7: lines and two arcs of a program",
                                         .x_label = "X",
                                         .y_label = "Y",
                                         .series = {path},
                                         .same_scale = true})});
    const ArcErrors first_errors = errors_of(first, first_points);
    const ArcErrors second_errors = errors_of(second, second_points);
    all.pictures.push_back(
        {"e7-errors.svg",
         to_svg(Chart{.title = "E7: distance of the arcs' points from the exact ones",
                      .x_label = "chord",
                      .y_label = "distance",
                      .series = {{.label = "G02", .x = first_errors.chord, .y = first_errors.distance},
                                 {.label = "G03", .x = second_errors.chord, .y = second_errors.distance}}})});
    all.findings.push_back(
        {"E7",
         "distance of the arcs' points from the exact ones",
         std::max(ArcErrors::largest(first_errors.distance), ArcErrors::largest(second_errors.distance))});
}

} // namespace

Experiments run_experiments() {
    Experiments all;
    fold_everything(all);
    rotate_everything(all);
    vector_everything(all);
    all_directions(all);
    one_arc(all);
    whole_program(all);
    return all;
}

} // namespace millwright::cordic
