#include "core/hpgl/internal/setup.h"

#include "core/base/counted.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::hpgl::internal {

void defaults(Run& run, const Given&) {
    run.modes = Modes();
    run.units.no_scale();
    run.misplace("SC", false);
    run.pen.window.reset();
    run.misplace("IW", false);
    run.pen.line.set_solid();
    run.lexer.end_labels_with('\x03', false);
}

void initialise(Run& run, const Given& given) {
    run.pen.lift();
    defaults(run, given);
    run.units.reset_points();
    run.units.rotate(0);
    for (const std::string_view setup : {"IP", "IR", "RO"}) {
        run.misplace(setup, false);
    }
}

void begin_plot(Run& run, const Given& given) {
    initialise(run, given);
}

void input_points(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.units.reset_points();
        return;
    }
    const Vec2 p1 = given.point(0);
    const Vec2 p2 = given.count() == 4 ? given.point(2) : Vec2(p1 + run.units.span());
    if (!run.units.set_points(p1, p2)) {
        return run.refuse("IP: P1 and P2 lie on one line, which does not define a scale");
    }
    run.misplace("IR", false);
}

void input_relative_points(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.units.reset_points();
        return;
    }
    const Vec2 sheet = run.settings.p2 - run.settings.p1;
    const Vec2 p1 = given.point(0);
    const Vec2 p2 =
        given.count() == 4 ? given.point(2) : Vec2(p1 + 100.0 * run.units.span().cwiseQuotient(sheet));
    if (!run.units.set_relative_points(p1, p2)) {
        return run.refuse("IR: P1 and P2 lie on one line, which does not define a scale");
    }
    run.misplace("IP", false);
}

void scale(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.units.no_scale();
        return;
    }
    if (given.count() < 4) {
        return run.refuse(
            fmt::format("SC: the type must be 0, 4, 5 or 7, not {}", counted(given.count(), "number")));
    }
    const Vec2 first(given[0], given[2]);
    const Vec2 second(given[1], given[3]);
    const double type = given.value(4, 0.0);
    bool done = false;
    if (type > 1.0) {
        done = run.units.scale_by_factor(first, second);
    } else if (type > 0.0) {
        done = run.units.scale_isotropic(first, second, {given.value(5, 50.0), given.value(6, 50.0)});
    } else {
        done = run.units.scale_to_fit(first, second);
    }
    if (!done) {
        return run.refuse("SC: these numbers do not define a scale");
    }
}

void rotate(Run& run, const Given& given) {
    if (!run.units.rotate(static_cast<int>(given.value(0, 0.0)))) {
        return run.refuse(fmt::format("RO: the angle must be 0, 90, 180 or 270 degrees, not {}", given[0]));
    }
}

void input_window(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.pen.window.reset();
        return;
    }
    const Vec2 a = run.units.plotter(given.point(0));
    const Vec2 b = run.units.plotter(given.point(2));
    run.pen.window = Window{.lower = a.cwiseMin(b), .upper = a.cwiseMax(b)};
}

void select_pen(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.pen.put_away();
        return;
    }
    const double number = given[0];
    const bool known = number >= 0.0 && number <= run.settings.highest_pen && !(std::floor(number) < number);
    if (!known) {
        run.pen.put_away(); // what follows was meant for another pen than any that is there
        return run.refuse(
            fmt::format("pen {} does not exist; the highest is {}. Nothing is drawn until the next pen",
                        number,
                        run.settings.highest_pen));
    }
    run.pen.select(static_cast<int>(number));
    run.plot.pens.try_emplace(static_cast<int>(number), run.usual);
}

namespace {

/// Of the pen that a command names, else of the one in use. Nothing if there is none of it, which is refused.
PenUse* use_meant(Run& run, const Given& given, std::size_t n) {
    const double number = given.value(n, run.pen.number().value_or(1));
    if (!(number >= 0.0 && number <= run.settings.highest_pen)) {
        run.refuse(fmt::format("pen {} does not exist; the highest is {}", number, run.settings.highest_pen));
        return nullptr;
    }
    return &run.plot.pens.try_emplace(static_cast<int>(number), run.usual).first->second;
}

} // namespace

void pen_speed(Run& run, const Given& given) {
    const double cm_per_s = given.value(0, 0.0);
    if (cm_per_s < 0.0) {
        return run.refuse(fmt::format("VS: {} cm/s is not a valid speed", cm_per_s));
    }
    constexpr double mm_per_cm = 10.0;
    const double speed = cm_per_s * mm_per_cm;
    if (given.count() < 2) { // all pens from here on
        run.usual.speed = speed;
        for (auto& [pen, use] : run.plot.pens) {
            use.speed = speed;
        }
    } else if (PenUse* use = use_meant(run, given, 1)) {
        use->speed = speed;
    }
}

void pen_width(Run& run, const Given& given) {
    const double width = given.value(0, 0.0);
    if (width < 0.0) {
        return run.refuse(fmt::format("PW: {} is not a valid width", width));
    }
    const double diagonal_mm =
        run.units.span().cwiseProduct(Vec2(run.settings.unit.x, run.settings.unit.y)).norm();
    if (PenUse* use = use_meant(run, given, 1)) {
        use->width = run.modes.width_relative ? width / 100.0 * diagonal_mm : width;
    }
}

void pen_thickness(Run& run, const Given& given) {
    pen_width(run, given);
}

void width_unit(Run& run, const Given& given) {
    run.modes.width_relative = given.value(0, 0.0) > 0.0;
}

void line_type(Run& run, const Given& given) {
    if (given.count() == 0 || !run.settings.dashes) {
        run.pen.line.set_solid();
        return;
    }
    const double type = given[0];
    if (!(std::abs(type) <= static_cast<double>(run.modes.patterns.size()))) {
        return run.refuse(fmt::format("LT: the line type must be -8 to 8, not {}", type));
    }
    const auto index = static_cast<int>(type);
    if (index == 0) {
        run.pen.line.set_dots();
        return;
    }
    const bool in_mm = given.value(2, 0.0) > 0.0;
    const double size = given.value(1, in_mm ? 5.0 : 4.0);
    const double length = in_mm ? size / run.settings.unit.x : size / 100.0 * run.diagonal();
    constexpr double least_mm = 0.1; // no pen and no tool makes finer dashes
    if (!(length * run.settings.unit.x >= least_mm)) {
        run.pen.line.set_solid();
        return run.refuse(fmt::format("LT: a pattern of {:.4g} mm is too fine to cut; lines are drawn solid",
                                      length * run.settings.unit.x));
    }
    const Pattern& pattern = run.modes.patterns[static_cast<std::size_t>(std::abs(index) - 1)];
    if (index > 0) {
        run.pen.line.set_pattern(pattern, length);
    } else {
        run.pen.line.set_adaptive(pattern, length);
    }
}

void user_line_type(Run& run, const Given& given) {
    if (given.count() == 0) {
        run.modes.patterns = initial_patterns();
        return;
    }
    const double index = std::abs(given[0]);
    if (!(index >= 1.0 && index <= static_cast<double>(run.modes.patterns.size()))) {
        return run.refuse(fmt::format("UL: the line type must be 1 to 8, not {}", given[0]));
    }
    const auto n = static_cast<std::size_t>(index) - 1;
    if (given.count() == 1) {
        run.modes.patterns[n] = initial_patterns()[n];
        return;
    }
    Pattern pattern;
    double sum = 0.0;
    for (const double part : given.numbers.subspan(1)) {
        if (part < 0.0) {
            return run.refuse(fmt::format("UL: {} percent is not a valid part", part));
        }
        pattern.push_back(part);
        sum += part;
    }
    if (!(sum > 0.0)) {
        return run.refuse("UL: the pattern has no length");
    }
    run.modes.patterns[n] = pattern;
}

namespace {

void tick(Run& run, const Vec2& across) {
    if (run.refuses_if_lost()) {
        return;
    }
    const Vec2 at = run.pen.at();
    const Vec2 reach = run.units.turned(across);
    run.pen.place(at - run.modes.ticks.negative * reach);
    run.pen.draw(at + run.modes.ticks.positive * reach);
    run.pen.place(at);
}

} // namespace

void x_tick(Run& run, const Given&) {
    tick(run, {0.0, run.units.span().y()});
}

void y_tick(Run& run, const Given&) {
    tick(run, {run.units.span().x(), 0.0});
}

void tick_length(Run& run, const Given& given) {
    run.modes.ticks = given.count() == 0
                          ? Ticks()
                          : Ticks{.positive = given[0] / 100.0, .negative = given.value(1, 0.0) / 100.0};
}

} // namespace millwright::hpgl::internal
