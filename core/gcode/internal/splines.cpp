// G5, G5.1: Bezier curves by their control points; G5.2, G5.3: a NURBS gathered point by point. All in the XY
// plane. As in LinuxCNC, G5 and G5.1 do not stay in force.
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

constexpr std::size_t most_points = 100'000;
constexpr double highest_order = 20.0;

void expect_flat(const Run& run, const Block& block) {
    const int column = block.column_of(GGroup::motion);
    if (run.state.cutter.on()) {
        refuse(column, "splines cannot be used with cutter compensation");
    }
    if (run.state.plane != Plane::xy) {
        refuse(column, "splines are only possible in the XY plane (G17)");
    }
    if (block.has_any(words_of("ZABC"))) {
        refuse(column, "a spline cannot move Z, A, B or C");
    }
}

void send_curve(Run& run, std::span<const ControlPoint> points, int order) {
    run.out.send(Curve{points, order, run.out.place()});
    run.state.position[Axis::x] = points.back().x;
    run.state.position[Axis::y] = points.back().y;
}

/// The first inner point of G5: given, or the last one of the G5 before, mirrored.
Vec2 first_handle(const Block& block, const Run& run) {
    if (block.has('I') != block.has('J')) {
        refuse(block.column_of(block.has('I') ? 'I' : 'J'), "G5 needs both I and J, or neither");
    }
    if (block.has('I')) {
        return {block['I'], block['J']};
    }
    if (!run.after_spline) {
        refuse(block.column_of(GGroup::motion), "the first G5 of a series needs I and J");
    }
    return {run.state.cycle.i, run.state.cycle.j};
}

} // namespace

void make_spline(Run& run, const Block& block, int motion) {
    ModalState& s = run.state;
    const int column = block.column_of(GGroup::motion);
    expect_flat(run, block);
    expect_feed(run, block, motion);
    const AxisValues end = end_of_move(block, s);
    const Vec2 from(s.position[Axis::x], s.position[Axis::y]);
    const Vec2 to(end[Axis::x], end[Axis::y]);
    constexpr int quadratic = 51;
    if (motion == quadratic) {
        if (!block.has('I') || !block.has('J')) {
            refuse(column, "G5.1 needs both I and J");
        }
        const std::array<ControlPoint, 3> points{
            {{from.x(), from.y()}, {from.x() + block['I'], from.y() + block['J']}, {to.x(), to.y()}}};
        send_curve(run, points, 3);
    } else {
        const Vec2 first = from + first_handle(block, run);
        if (!block.has('P') || !block.has('Q')) {
            refuse(column, "G5 needs both P and Q");
        }
        const std::array<ControlPoint, 4> points{{{from.x(), from.y()},
                                                  {first.x(), first.y()},
                                                  {to.x() + block['P'], to.y() + block['Q']},
                                                  {to.x(), to.y()}}};
        send_curve(run, points, 4);
        s.cycle.i = -block['P'];
        s.cycle.j = -block['Q'];
        run.after_spline = true;
    }
}

void add_nurbs_point(Run& run, const Block& block) {
    ModalState& s = run.state;
    NurbsBeingDefined& nurbs = run.nurbs;
    const int column = block.column_of(GGroup::motion);
    constexpr int g5_2 = 52;
    expect_flat(run, block);
    expect_feed(run, block, g5_2);
    if (block.has('X') != block.has('Y')) {
        refuse(column, "G5.2 needs both X and Y");
    }
    if (s.motion != g5_2) {
        nurbs = {};
    }
    const bool first = nurbs.points.empty();
    const double weight = block.value_or('P', first ? 1.0 : 0.0);
    if (!(weight > 0.0)) {
        refuse(block.column_of('P'), "a control point needs a positive weight, P");
    }
    if (first) {
        nurbs.points.push_back({s.position[Axis::x], s.position[Axis::y], block.has('X') ? 1.0 : weight});
    } else if (!block.has('X')) {
        refuse(column, "only the first G5.2 may omit X and Y");
    }
    if (block.has('L') && block['L'] > 3.0) {
        if (block['L'] > highest_order) {
            refuse(block.column_of('L'),
                   fmt::format("the order of a NURBS, L, must be at most {}", highest_order));
        }
        nurbs.order = static_cast<int>(block['L']);
    }
    if (block.has('X')) {
        if (nurbs.points.size() >= most_points) {
            refuse(column, fmt::format("a NURBS may have at most {} control points", most_points));
        }
        const AxisValues end = end_of_move(block, s);
        nurbs.points.push_back({end[Axis::x], end[Axis::y], weight});
    }
    s.motion = g5_2;
}

void make_nurbs(Run& run, const Block& block) {
    const int column = block.column_of(GGroup::non_modal);
    constexpr int g5_2 = 52;
    constexpr int none = 800;
    if (run.state.motion != g5_2) {
        refuse(column, "G5.3 needs a G5.2 before it");
    }
    if (static_cast<int>(run.nurbs.points.size()) < run.nurbs.order) {
        refuse(column,
               fmt::format("a NURBS of order {} needs at least as many control points", run.nurbs.order));
    }
    send_curve(run, run.nurbs.points, run.nurbs.order);
    run.nurbs = {};
    run.state.motion = none;
}

} // namespace millwright::gcode::internal
