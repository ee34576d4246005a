#include "core/plot/hpgl/internal/moves.h"

#include "core/plot/hpgl/internal/letters.h"

namespace millwright::plot::internal {
namespace {

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
    run.modes.relative = false;
    follow(run, given);
}

void plot_relative(Run& run, const Given& given) {
    run.modes.relative = true;
    follow(run, given);
}

void pen_up(Run& run, const Given& given) {
    run.pen.lift();
    follow(run, given);
}

void pen_down(Run& run, const Given& given) {
    run.pen.lower();
    follow(run, given);
}

} // namespace millwright::plot::internal
