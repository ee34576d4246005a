#include "core/plot/hpgl/internal/moves.h"

#include "core/plot/hpgl/internal/letters.h"

#include <fmt/format.h>

namespace millwright::plot::internal {
namespace {

/// All positions at once, so that nothing is drawn on the way to a damaged one. Throws Refusal.
void expect_near(const Run& run, const Given& given, bool relative) {
    const Vec2 unit(run.settings.unit.x, run.settings.unit.y);
    Vec2 at = run.pen.at();
    for (std::size_t n = 0; n + 1 < given.count(); n += 2) {
        at = relative ? Vec2(at + run.units.plotter_step(given.point(n))) : run.units.plotter(given.point(n));
        const double far = at.cwiseProduct(unit).cwiseAbs().maxCoeff();
        if (!(far <= run.settings.farthest)) {
            constexpr double m = 1e-3;
            throw Refusal{fmt::format(
                "a position {:.0f} m away from the origin: two numbers may have become one", m * far)};
        }
    }
}

void follow(Run& run, const Given& given) {
    for (std::size_t n = 0; n + 1 < given.count(); n += 2) {
        if (run.modes.relative) {
            run.pen.step(run.units.plotter_step(given.point(n)));
        } else {
            run.pen.go(run.units.plotter(given.point(n)));
        }
        draw_symbol(run);
    }
}

} // namespace

void plot_absolute(Run& run, const Given& given) {
    expect_near(run, given, false);
    run.modes.relative = false;
    follow(run, given);
}

void plot_relative(Run& run, const Given& given) {
    expect_near(run, given, true);
    run.modes.relative = true;
    follow(run, given);
}

void pen_up(Run& run, const Given& given) {
    expect_near(run, given, run.modes.relative);
    run.pen.lift();
    follow(run, given);
}

void pen_down(Run& run, const Given& given) {
    expect_near(run, given, run.modes.relative);
    run.pen.lower();
    follow(run, given);
}

} // namespace millwright::plot::internal
