#include "core/gcode/internal/compensation_lookahead.h"

#include "core/gcode/internal/plane_geometry.h"
#include "core/gcode/internal/refusal.h"

#include <cmath>
#include <utility>

namespace millwright::gcode::internal {

namespace {

/// Lathe tools are programmed by the corner of their tip, not by the centre of its radius.
void shift_to_tip(Move& move, const ModalState& s) {
    if (s.plane != Plane::xz) {
        return;
    }
    const int o = s.cutter.orientation;
    const double r = s.cutter.radius;
    const auto shift = [r](bool minus, bool plus) { return minus ? -r : plus ? r : 0.0; };
    const double x = shift(o == 2 || o == 6 || o == 1, o == 3 || o == 8 || o == 4);
    const double z = shift(o == 2 || o == 7 || o == 3, o == 1 || o == 5 || o == 4);
    move.target[Axis::x] += x;
    move.target[Axis::z] += z;
    move.centre_1 += z;
    move.centre_2 += x;
}

// ---- the end of the moves that wait

/// Compensation has made an arc of different radii, in the program's unit (LinuxCNC's).
constexpr double arc_mismatch = 0.01;

void move_arc_end(const Run& run, Waiting& waiting, const Vec2& end) {
    const PlaneAxes axes = axes_of(run.state.plane);
    const Vec2 centre(waiting.move.centre_1, waiting.move.centre_2);
    const double before = (in_plane(waiting.move.target, axes) - centre).norm();
    if (!(std::abs(before - (end - centre).norm()) <= arc_mismatch)) {
        refuse(1, "the arc cannot be compensated: the radii at its ends differ");
    }
    const double programmed = std::abs(waiting.sweep);
    if (programmed > 0.0 && run.compensated_begin_known) {
        // Longer than programmed by more than LinuxCNC lets pass: the tool backs through the contour.
        const double tolerance = run.state.unit == LengthUnit::mm ? 0.0254 : 0.001;
        const double now = std::abs(sweep_of(run.compensated_begin, end, centre, waiting.move.turns));
        if (now > programmed + tolerance) {
            refuse(1, "the tool cannot reach the arc in this concave corner without gouging");
        }
    }
    put_in_plane(waiting.move.target, axes, end);
}

void move_straight_end(const Run& run, Waiting& waiting, const Vec2& end) {
    const Vec2 now = end - run.compensated_begin;
    if (run.compensated_begin_known && waiting.direction.dot(now) < 0.0) {
        refuse(1, "the tool cannot reach the straight move in this concave corner without gouging");
    }
    put_in_plane(waiting.move.target, axes_of(run.state.plane), end);
}

} // namespace

void hold(Run& run, const Move& move, const Vec2& direction, double sweep) {
    Waiting waiting;
    waiting.move = move;
    waiting.move.source = run.out.place();
    waiting.direction = direction;
    waiting.sweep = sweep;
    run.out.waiting().push_back(std::move(waiting));
}

void finish_at(Run& run, const Vec2& end) {
    if (run.out.waiting().empty()) {
        return;
    }
    for (Waiting& waiting : run.out.waiting()) {
        if (!waiting.is_move) {
            continue;
        }
        if (waiting.move.kind == MoveKind::arc) {
            move_arc_end(run, waiting, end);
        } else {
            move_straight_end(run, waiting, end);
        }
    }
    flush_waiting(run);
    run.compensated_begin = end;
    run.compensated_begin_known = true;
}

void begin_at(Run& run, const Vec2& point) {
    run.compensated_begin = point;
    run.compensated_begin_known = true;
}

void flush_waiting(Run& run) {
    run.compensated_begin_known = false;
    // What is sent must not wait behind itself.
    std::vector<Waiting> waiting = std::move(run.out.waiting());
    run.out.waiting().clear();
    for (Waiting& one : waiting) {
        if (one.is_move) {
            if (one.move.kind == MoveKind::arc) {
                const Vec2 centre(one.move.centre_1, one.move.centre_2);
                const Vec2 end = in_plane(one.move.target, axes_of(run.state.plane));
                one.move.sweep = sweep_of(run.flushed_to, end, centre, one.move.turns);
            }
            run.flushed_to = in_plane(one.move.target, axes_of(run.state.plane));
            shift_to_tip(one.move, run.state);
            run.out.send(one.move);
        } else {
            one.command.text = one.text;
            run.out.send(one.command);
        }
    }
}

void finish_waiting(Run& run) {
    finish_at(run, in_plane(run.state.position, axes_of(run.state.plane)));
    flush_waiting(run);
}

} // namespace millwright::gcode::internal
