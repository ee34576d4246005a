#include "core/gcode/internal/compensation.h"

#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/internal/compensation_lookahead.h"
#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/plane_geometry.h"
#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::gcode::internal {

namespace {

/// Radius and orientation that the words of the line ask for.
struct Cutter {
    double radius;
    int orientation;
};

Cutter cutter_of_words(const Block& block, const ModalState& s, int code) {
    const int column = block.column_of(GGroup::cutter_compensation);
    if (!block.has('D')) {
        refuse(column, fmt::format("G{}.1 needs the cutter diameter, D", code / 10));
    }
    const int orientation = block.has('L') ? static_cast<int>(block['L']) : 0;
    if (block.has('L') && s.plane != Plane::xz) {
        refuse(block.column_of('L'),
               fmt::format("L of G{}.1 is only for lathe tools in the XZ plane (G18)", code / 10));
    }
    return {0.5 * block['D'], orientation};
}

/// A length of the tool table in the program's unit, rounded as LinuxCNC rounds it, for which an inch is
/// 1 / 0.03937007874016 mm: on that hangs whether a move as long as the radius is longer, as many programs
/// have it.
double table_length(const Run& run, double length) {
    constexpr double inches_of_mm = 0.03937007874016;
    const double mm = run.settings.machine_unit == LengthUnit::inch ? length / inches_of_mm : length;
    return run.state.unit == LengthUnit::inch ? mm / mm_per_inch : mm;
}

Cutter cutter_of_table(Run& run, const Block& block, int code) {
    const int column = block.column_of(GGroup::cutter_compensation);
    Tool tool = run.state.spindle_tool;
    if (block.has('D')) {
        const double d = block['D'];
        const int number = static_cast<int>(std::round(d));
        if (std::abs(d - number) > whole_within || number < 0) {
            refuse(block.column_of('D'), fmt::format("D of G{} must be a tool number", code / 10));
        }
        const int row = run.row_of_tool(number);
        if (row < 0) {
            refuse(block.column_of('D'), fmt::format("tool {} is not in the tool table", number));
        }
        tool = row == 0 ? tool : run.tools.at_row(row);
    }
    const bool lathe_tool = tool.orientation != 0 && tool.orientation != 9;
    if (lathe_tool && run.state.plane != Plane::xz) {
        refuse(column, fmt::format("G{} with a lathe tool works in the XZ plane (G18) only", code / 10));
    }
    return {0.5 * table_length(run, tool.diameter), tool.orientation};
}

double left_or_right(const ModalState& s) {
    return s.cutter.side == CutterSide::left ? 1.0 : -1.0;
}

/// To the side of the tool, of a motion in `direction`.
Vec2 towards_tool(const Vec2& direction, double side) {
    return side * Vec2(-direction.y(), direction.x());
}

/// What was offset last, as the corner with the next element sees it.
PathElement element_before(const Run& run, const Vec2& corner, const Vec2& tool, double side) {
    const Vec2 normal = (tool - corner).normalized();
    PathElement element;
    element.direction = side * Vec2(normal.y(), -normal.x());
    const auto& waiting = run.out.waiting();
    if (!waiting.empty() && waiting.front().move.kind == MoveKind::arc) {
        element.is_arc = true;
        element.centre = {waiting.front().move.centre_1, waiting.front().move.centre_2};
        element.offset_radius =
            (in_plane(waiting.front().move.target, axes_of(run.state.plane)) - element.centre).norm();
        element.turns = waiting.front().move.turns;
    }
    return element;
}

/// Round the outside of a convex corner; `move` has the target of the next element, of which the other axes
/// count.
void go_round(Run& run, Move move, const Vec2& corner, const Vec2& from, const Vec2& to, double third) {
    const PlaneAxes axes = axes_of(run.state.plane);
    move.plane = run.state.plane;
    put_in_plane(move.target, axes, to);
    move.target[axes.third] = third;
    if (move.kind != MoveKind::traverse) { // there is no traverse along an arc
        move.kind = MoveKind::arc;
        move.turns = run.state.cutter.side == CutterSide::left ? -1 : 1;
        move.centre_1 = corner.x();
        move.centre_2 = corner.y();
        move.sweep = sweep_of(from, to, corner, move.turns);
    }
    hold(run, move, Vec2::Zero(), 0.0);
    flush_waiting(run);
    begin_at(run, to);
}

/// Ends the moves that wait in the corner to `next`, which begins with the tool at `next_tool`.
void turn_corner(
    Run& run, const Move& move, const Vec2& corner, const PathElement& next, const Vec2& next_tool) {
    ModalState& s = run.state;
    const PlaneAxes axes = axes_of(s.plane);
    const double side = left_or_right(s);
    const Vec2 tool = in_plane(s.position, axes);
    const PathElement before = element_before(run, corner, tool, side);
    switch (corner_between(before, next, side)) {
    case Corner::concave:
        finish_at(run, meeting_point({before, next, corner, tool, s.cutter.radius, side}));
        break;
    case Corner::convex:
        if (next.is_arc) {
            flush_waiting(run);
        } else {
            finish_at(run, tool);
        }
        go_round(run, move, corner, tool, next_tool, s.position[axes.third]);
        break;
    case Corner::smooth:
        flush_waiting(run);
        begin_at(run, tool);
        break;
    }
}

void arrive(Run& run, const AxisValues& programmed, const AxisValues& tool) {
    run.state.programmed = programmed;
    run.state.position = tool;
    run.state.cutter.first_move = false;
}

void enter_straight(Run& run, Move move, const AxisValues& end) {
    ModalState& s = run.state;
    const PlaneAxes axes = axes_of(s.plane);
    const Vec2 from = in_plane(s.position, axes);
    const Vec2 to = in_plane(end, axes);
    if (!(std::hypot(to.x() - from.x(), to.y() - from.y()) > s.cutter.radius)) {
        refuse(1, "the entry move to the compensated path must be longer than the tool radius");
    }
    const Vec2 direction = (to - from).normalized();
    const Vec2 normal = towards_tool(direction, left_or_right(s));
    put_in_plane(move.target, axes, to + s.cutter.radius * normal);
    move.plane = s.plane;
    move.enters_compensation = true;
    begin_at(run, from);
    run.flushed_to = from;
    // LinuxCNC remembers the normal here: such a move is long enough never to be turned round.
    hold(run, move, normal, 0.0);
    arrive(run, end, move.target);
}

/// The arc that stays tangent to the programmed one while it leads from the tool's place to its side.
void enter_arc(Run& run, Move arc, int column) {
    ModalState& s = run.state;
    const PlaneAxes axes = axes_of(s.plane);
    const double side = left_or_right(s);
    const Vec2 from = in_plane(s.position, axes);
    const Vec2 to = in_plane(arc.target, axes);
    const Vec2 centre(arc.centre_1, arc.centre_2);
    if (!((to - from).norm() > s.cutter.radius)) {
        refuse(column, "the entry arc to the compensated path must be longer than the tool radius");
    }
    const AxisValues programmed = arc.target;
    const Vec2 inward = (centre - to).normalized();
    const bool inside = tool_inside_arc(arc.turns, side);
    const Vec2 end = to + s.cutter.radius * (inside ? inward : Vec2(-inward));
    // The new centre lies on the line through end and old centre, as far from both ends; it must be on the
    // same side (LinuxCNC goes on with one on the other side, and leaves the contour).
    const Vec2 back = from - end;
    const double along = inward.dot(back);
    constexpr double least_cosine = 1e-6;
    if (!(along >= least_cosine * back.norm())) {
        refuse(column, "the entry arc to the compensated path is too short for the tool radius");
    }
    const Vec2 new_centre = end + 0.5 * back.squaredNorm() / along * inward;
    check_centre(from, end, new_centre, arc_tolerances(s.unit, run.settings.dialect), s.plane, column);
    run.flushed_to = from;
    if (s.cutter.orientation != 0 && s.cutter.orientation != 9) {
        Move lead = arc; // a lathe tool's tip moves first, or the arc were none
        lead.kind = MoveKind::feed;
        lead.target = programmed;
        put_in_plane(lead.target, axes, from);
        lead.target[axes.third] = s.position[axes.third];
        hold(run, lead, Vec2::Zero(), 0.0);
        begin_at(run, from);
    }
    arc.centre_1 = new_centre.x();
    arc.centre_2 = new_centre.y();
    arc.sweep = sweep_of(from, end, new_centre, arc.turns);
    put_in_plane(arc.target, axes, end);
    hold(run, arc, Vec2::Zero(), arc.sweep);
    arrive(run, programmed, arc.target);
}

void expect_fit(const Run& run, const Move& arc, const Vec2& end, int column) {
    const double radius = (Vec2(arc.centre_1, arc.centre_2) - end).norm();
    const double left = radius - run.state.cutter.radius;
    const double least = arc_tolerances(run.state.unit, run.settings.dialect).smallest_radius;
    if (tool_inside_arc(arc.turns, left_or_right(run.state)) && !(left >= least)) {
        refuse(column, "the tool radius must be less than the arc radius");
    }
}

} // namespace

void start_compensation(Run& run, const Block& block, int code) {
    ModalState& s = run.state;
    const int column = block.column_of(GGroup::cutter_compensation);
    if (s.plane != Plane::xy && s.plane != Plane::xz) {
        refuse(column, "cutter compensation works in the XY and XZ planes only (G17, G18)");
    }
    if (s.cutter.on()) {
        refuse(column, "cutter compensation is already on");
    }
    const bool by_words = code == 411 || code == 421;
    const Cutter cutter = by_words ? cutter_of_words(block, s, code) : cutter_of_table(run, block, code);
    const bool left = (code == 410 || code == 411) == (cutter.radius >= 0.0);
    run.out.post(command_of(CommandKind::comment,
                            left ? "interpreter: cutter radius compensation on left"
                                 : "interpreter: cutter radius compensation on right"));
    s.cutter.radius = std::abs(cutter.radius);
    s.cutter.orientation = cutter.orientation;
    s.cutter.side = left ? CutterSide::left : CutterSide::right;
    s.cutter.first_move = true;
    run.compensated_begin_known = false;
}

void stop_compensation(Run& run) {
    ModalState& s = run.state;
    const bool moved = s.cutter.on() && s.cutter.radius > 0.0 && !s.cutter.first_move;
    run.out.post(command_of(CommandKind::comment, "interpreter: cutter radius compensation off"));
    finish_waiting(run);
    if (moved) {
        for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
            s.position[axis] = s.programmed[axis];
        }
    }
    s.cutter.arc_forbidden = s.cutter.arc_forbidden || (s.cutter.on() && s.cutter.radius > 0.0);
    s.cutter.side = CutterSide::off;
    s.cutter.first_move = true;
}

void compensate_straight(Run& run, MoveKind kind, const AxisValues& end) {
    ModalState& s = run.state;
    Move move = run.out.new_move(kind);
    move.target = end;
    if (s.cutter.first_move) {
        enter_straight(run, move, end);
        return;
    }
    const PlaneAxes axes = axes_of(s.plane);
    const Vec2 corner = in_plane(s.programmed, axes);
    const Vec2 way = in_plane(end, axes) - corner;
    if (exactly_equal(way.x(), 0.0) && exactly_equal(way.y(), 0.0)) {
        put_in_plane(move.target, axes, in_plane(s.position, axes));
        hold(run, move, way, 0.0);
        arrive(run, end, move.target);
        return;
    }
    PathElement next;
    next.direction = way.normalized();
    const Vec2 normal = s.cutter.radius * towards_tool(next.direction, left_or_right(s));
    turn_corner(run, move, corner, next, corner + normal);
    put_in_plane(move.target, axes, in_plane(end, axes) + normal);
    hold(run, move, way, 0.0);
    arrive(run, end, move.target);
}

void compensate_arc(Run& run, const Move& arc, int column) {
    ModalState& s = run.state;
    const PlaneAxes axes = axes_of(s.plane);
    const Vec2 to = in_plane(arc.target, axes);
    expect_fit(run, arc, to, column);
    if (s.cutter.first_move) {
        enter_arc(run, arc, column);
        return;
    }
    const double side = left_or_right(s);
    const bool inside = tool_inside_arc(arc.turns, side);
    const Vec2 corner = in_plane(s.programmed, axes);
    PathElement next;
    next.is_arc = true;
    next.centre = {arc.centre_1, arc.centre_2};
    next.turns = arc.turns;
    next.offset_radius = (next.centre - corner).norm() + (inside ? -s.cutter.radius : s.cutter.radius);
    const Vec2 inward = (next.centre - corner).normalized();
    next.direction = arc.turns > 0 ? Vec2(inward.y(), -inward.x()) : Vec2(-inward.y(), inward.x());
    const double sign = inside ? 1.0 : -1.0;
    turn_corner(run, arc, corner, next, corner + sign * s.cutter.radius * inward);

    Move move = arc;
    const Vec2 tool = to + sign * s.cutter.radius * (next.centre - to).normalized();
    put_in_plane(move.target, axes, tool);
    hold(run, move, Vec2::Zero(), arc.sweep);
    arrive(run, arc.target, move.target);
}

} // namespace millwright::gcode::internal
