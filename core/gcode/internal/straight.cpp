#include "core/base/numbers.h"
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/compensation.h"
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"
#include "core/gcode/inverse_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

void send_straight(Run& run, MoveKind kind, const AxisValues& end) {
    Move move = run.out.new_move(kind);
    move.target = end;
    run.out.send(move);
    run.state.position = end;
}

void expect_turning_spindle(const Run& run, const Block& block, int motion) {
    if (run.state.spindle == SpindleTurning::stopped) {
        refuse(block.column_of(GGroup::motion), fmt::format("{} needs a turning spindle", g_name(motion)));
    }
}

} // namespace

void expect_feed(const Run& run, const Block& block, int motion) {
    const ModalState& s = run.state;
    const int column = block.column_of(GGroup::motion);
    if (s.feed_mode == FeedMode::inverse_time) {
        if (!block.has('F')) {
            refuse(column,
                   fmt::format("in inverse time mode (G93) {} needs an F in its line", g_name(motion)));
        }
        return;
    }
    if (exactly_equal(s.feed_rate, 0.0)) {
        refuse(column, fmt::format("{} with a feed of zero", g_name(motion)), "give F");
    }
    if (s.feed_mode == FeedMode::per_revolution && exactly_equal(s.spindle_speed, 0.0)) {
        refuse(column, "feed per revolution (G95) with a spindle speed of zero");
    }
}

void set_inverse_time_feed(Run& run, const Block& block, double length) {
    if (run.state.feed_mode != FeedMode::inverse_time) {
        return;
    }
    const double rate = std::max(least_inverse_time_feed, length * block['F']);
    run.out.post(CommandKind::set_feed_rate, 0, rate);
    run.state.feed_rate = rate;
}

void make_straight(Run& run, const Block& block, int motion) {
    ModalState& s = run.state;
    const bool feed = motion == 10;
    s.cutter.arc_forbidden = false;
    if (feed) {
        expect_feed(run, block, motion);
    }
    s.motion = motion;
    const AxisValues end = end_of_move(block, s);
    const bool compensated = s.cutter.on() && s.cutter.radius > 0.0;
    if (feed && s.feed_mode == FeedMode::inverse_time) {
        const AxisValues& from = compensated && !s.cutter.first_move ? s.programmed : s.position;
        set_inverse_time_feed(run, block, straight_length(from, end));
    }
    if (compensated) {
        constexpr int g53 = 530;
        if (block.code(GGroup::non_modal) == g53) {
            refuse(block.column_of(GGroup::non_modal), "G53 while cutter compensation is on");
        }
        compensate_straight(run, feed ? MoveKind::feed : MoveKind::traverse, end);
        return;
    }
    send_straight(run, feed ? MoveKind::feed : MoveKind::traverse, end);
}

void make_synchronised(Run& run, const Block& block, int motion) {
    ModalState& s = run.state;
    s.cutter.arc_forbidden = false;
    if (s.cutter.on()) {
        refuse(block.column_of(GGroup::motion),
               fmt::format("{} while cutter compensation is on", g_name(motion)));
    }
    expect_turning_spindle(run, block, motion);
    s.motion = motion;
    const AxisValues end = end_of_move(block, s);
    run.out.send(CommandKind::start_speed_feed_synch, 0, block['K']);
    if (motion == 330) {
        send_straight(run, MoveKind::feed, end);
    } else {
        Move tap = run.out.new_move(MoveKind::rigid_tap); // comes back to where it began
        tap.target = end;
        run.out.send(tap);
    }
    run.out.send(CommandKind::stop_speed_feed_synch);
}

void take_probe_for_tripped(Run& run, const AxisValues& target) {
    AxisValues& position = run.state.position;
    run.variables.set_axes(parameter_probe, target, every_axis, every_axis);
    run.variables.set(parameter_probe_result, 0.0);
    constexpr double backoff_inch = 0.01;
    const double backoff = run.state.unit == LengthUnit::mm ? backoff_inch * mm_per_inch : backoff_inch;
    const AxisValues from = position;
    const double length = std::hypot(
        from[Axis::x] - target[Axis::x], from[Axis::y] - target[Axis::y], from[Axis::z] - target[Axis::z]);
    position = target;
    if (length > 0.0) {
        for (const Axis axis : {Axis::x, Axis::y, Axis::z}) {
            position[axis] += backoff * (from[axis] - target[axis]) / length;
        }
    }
}

void make_probe(Run& run, const Block& block, int motion) {
    ModalState& s = run.state;
    const int column = block.column_of(GGroup::motion);
    if (s.cutter.on()) {
        refuse(column, "probing while cutter compensation is on");
    }
    if (exactly_equal(s.feed_rate, 0.0)) {
        refuse(column, "probing with a feed of zero", "give F");
    }
    if (s.feed_mode == FeedMode::per_revolution) {
        refuse(column, "probing with feed per revolution (G95)");
    }
    Move move = run.out.new_move(MoveKind::probe);
    move.probe = static_cast<std::uint8_t>(motion - 380);
    move.target = end_of_move(block, s);
    const bool fails_if_not_tripped = move.probe == 2 || move.probe == 4;
    bool moves = false;
    for (std::size_t n = 0; n < axis_count; ++n) {
        moves = moves || !exactly_equal(move.target[n], s.position[n]);
    }
    if (fails_if_not_tripped && !moves) {
        refuse(column, "the probe is where it is to be moved to");
    }
    run.out.send(CommandKind::turn_probe_on);
    run.out.send(move);
    run.out.send(CommandKind::turn_probe_off);
    s.motion = motion;
    take_probe_for_tripped(run, move.target);
}

} // namespace millwright::gcode::internal
