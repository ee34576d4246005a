// G76: a thread in several passes, along Z (the drive line), with X as depth. Words as LinuxCNC's manual
// names them: P pitch, Z end, I offset of the thread's peak from the drive line, J first depth, K full depth,
// R degression, Q compound slide angle, H spring passes, E taper length, L taper ends.
#include "core/base/units.h"
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"

#include <cmath>

namespace millwright::gcode::internal {

namespace {

struct Thread {
    Run& run;
    AxisValues start;  ///< the drive line
    double inward;     ///< +1 where depth grows with X (internal threads), -1 else
    double peak;       ///< from the drive line to the thread's peak, > 0
    double first_cut;  ///< depth of the first pass, > 0
    double full_depth; ///< > first_cut
    double end_z;
    double pitch;
    double slide;       ///< tangent of the compound slide's angle, signed by the way
    double taper = 0.0; ///< length of the tapers, signed by the way
    bool taper_in = false, taper_out = false;

    /// Pitch along the slanted taper.
    [[nodiscard]] double taper_pitch() const {
        return pitch * std::hypot(taper, full_depth) / std::abs(taper);
    }
    void go(MoveKind kind, double depth, double z) const {
        Move move = run.out.new_move(kind);
        move.target = start;
        move.target[Axis::x] += inward * depth;
        move.target[Axis::z] = z;
        run.out.send(move);
    }
    void synchronise(double with) const { run.out.send(CommandKind::start_speed_feed_synch, 0, with); }
};

/// One pass; `depth` counts from the drive line.
void cut_pass(const Thread& t, double depth) {
    const double shift = (depth - t.peak) * t.slide;
    const double begin_z = t.start[Axis::z] - shift;
    const double end_z = t.end_z + t.full_depth * t.slide - shift;
    const double outside = depth - (t.full_depth + t.peak);
    t.go(MoveKind::traverse, outside, begin_z);
    if (t.taper_in) {
        t.run.out.send(CommandKind::disable_feed_override);
        t.synchronise(t.taper_pitch());
        t.go(MoveKind::feed, depth - t.full_depth, begin_z);
        t.go(MoveKind::feed, depth, begin_z - t.taper);
    } else {
        t.go(MoveKind::traverse, depth, begin_z);
        t.run.out.send(CommandKind::disable_feed_override);
    }
    t.synchronise(t.pitch);
    if (t.taper_out) {
        t.go(MoveKind::feed, depth, end_z + t.taper);
        t.synchronise(t.taper_pitch());
        t.go(MoveKind::feed, depth - t.full_depth, end_z);
    } else {
        t.go(MoveKind::feed, depth, end_z);
    }
    t.run.out.send(CommandKind::stop_speed_feed_synch);
    t.go(MoveKind::traverse, outside, end_z);
    t.run.out.send(CommandKind::enable_feed_override);
    t.run.feed_override_enabled = true;
}

void check_threading_words(const Block& block) {
    const double i = block['I'];
    if (!(i < 0.0 || i > 0.0)) {
        refuse(block.column_of('I'), "I of G76 must not be 0");
    }
    if (!(block['J'] > 0.0)) {
        refuse(block.column_of('J'), "J of G76 must be greater than 0");
    }
    if (!(block['K'] > block['J'])) {
        refuse(block.column_of('K'), "K of G76 must be greater than J");
    }
    constexpr double steepest = 80.0;
    if (std::abs(block.value_or('Q', 0.0)) > steepest) {
        refuse(block.column_of('Q'), "Q of G76 must be an angle between -80 and 80 degrees");
    }
    constexpr double most_springs = 1000.0;
    if (block.value_or('H', 0.0) > most_springs) {
        refuse(block.column_of('H'), "G76 may have at most 1000 spring passes");
    }
}

Thread thread_of(Run& run, const Block& block, const AxisValues& end) {
    const double scale = run.state.diameter_mode ? 0.5 : 1.0;
    const double way = end[Axis::z] > run.state.position[Axis::z] ? -1.0 : 1.0;
    Thread t{run,
             run.state.position,
             block['I'] > 0.0 ? 1.0 : -1.0,
             std::abs(block['I']) * scale,
             block['J'] * scale,
             block['K'] * scale,
             end[Axis::z],
             block['P'],
             way * std::tan(from_degrees(block.value_or('Q', 0.0)))};
    const double taper = std::max(0.0, block.value_or('E', 0.0));
    const int ends = static_cast<int>(block.value_or('L', 0.0));
    t.taper = way * taper;
    t.taper_in = taper > 0.0 && (ends & 1) != 0;
    t.taper_out = taper > 0.0 && (ends & 2) != 0;
    return t;
}

void expect_ready(const Run& run, const Block& block, const AxisValues& end) {
    const int column = block.column_of(GGroup::motion);
    if (run.state.cutter.on()) {
        refuse(column, "G76 cannot be used while cutter compensation is on");
    }
    if (run.state.spindle == SpindleTurning::stopped) {
        refuse(column, "G76 needs a running spindle");
    }
    for (std::size_t n = 3; n < axis_count; ++n) {
        if (end[n] < run.state.position[n] || end[n] > run.state.position[n]) {
            refuse(column, "G76 can only move X, Y and Z");
        }
    }
}

} // namespace

void make_threading(Run& run, const Block& block) {
    ModalState& s = run.state;
    s.cutter.arc_forbidden = false;
    const AxisValues end = end_of_move(block, s);
    expect_ready(run, block, end);
    check_threading_words(block);
    s.motion = 760;
    const Thread t = thread_of(run, block, end);
    const double degression = std::max(1.0, block.value_or('R', 1.0));
    const double deepest = t.full_depth + t.peak;
    constexpr double moves_of_a_pass = 5.0;
    const double passes = std::ceil(std::pow(t.full_depth / t.first_cut, degression));
    run.out.expect_room_for((passes + block.value_or('H', 0.0) + 1.0) * moves_of_a_pass);
    double depth = t.peak + t.first_cut;
    for (int pass = 2; depth < deepest; ++pass) {
        cut_pass(t, depth);
        depth = t.peak + t.first_cut * std::pow(pass, 1.0 / degression);
    }
    const int spring_passes = static_cast<int>(block.value_or('H', 0.0));
    for (int n = 0; n <= spring_passes; ++n) {
        cut_pass(t, deepest);
    }
    Move home = run.out.new_move(MoveKind::traverse);
    home.target = end;
    run.out.send(home);
    s.position = end;
}

} // namespace millwright::gcode::internal
