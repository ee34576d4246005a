#include "core/hpgl/internal/moves.h"

#include <algorithm>
#include <cmath>

namespace millwright::hpgl::internal {
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

} // namespace millwright::hpgl::internal
