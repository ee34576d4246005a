#include "core/hpgl/internal/moves.h"

#include "core/hpgl/internal/letters.h"

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

} // namespace millwright::hpgl::internal
