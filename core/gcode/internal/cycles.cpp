// Canned cycles G73, G74 and G81 to G89, in any plane: down from R to the bottom along the axis across the
// plane.
#include "core/base/numbers.h"
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/path_modes.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

/// How far a pecking drill comes down in rapid above where it was.
constexpr double peck_clearance_inch = 0.01;

/// One hole: heights are along the drilling axis.
struct Hole {
    Run& run;
    PlaneAxes axes;
    double r;
    double clear; ///< where the tool retracts to
    double bottom;
    double p = 0.0, q = 0.0;
    double offset_1 = 0.0, offset_2 = 0.0, middle = 0.0; ///< of back boring (G87)

    void go(MoveKind kind, double first, double second, double height) const {
        Move move = run.out.new_move(kind);
        move.target = run.state.position;
        move.target[axes.first] = first;
        move.target[axes.second] = second;
        move.target[axes.third] = height;
        run.out.send(move);
    }
    void feed(double height) const { go(MoveKind::feed, first(), second(), height); }
    void rapid(double height) const { go(MoveKind::traverse, first(), second(), height); }
    void rapid_aside(double height) const {
        go(MoveKind::traverse, first() + offset_1, second() + offset_2, height);
    }
    [[nodiscard]] double first() const { return run.state.position[axes.first]; }
    [[nodiscard]] double second() const { return run.state.position[axes.second]; }
    void dwell() const { run.out.send(CommandKind::dwell, 0, p); }
    void stop_spindle() const { run.out.send(CommandKind::stop_spindle_turning); }
    void turn_spindle(bool clockwise) const {
        run.out.send(clockwise ? CommandKind::start_spindle_clockwise
                               : CommandKind::start_spindle_counterclockwise);
    }
    [[nodiscard]] bool clockwise() const { return run.state.spindle == SpindleTurning::clockwise; }
};

void peck(const Hole& hole, bool break_chips_only) {
    const double clearance =
        peck_clearance_inch * (hole.run.state.unit == LengthUnit::mm ? mm_per_inch : 1.0);
    for (double depth = hole.r - hole.q; depth > hole.bottom; depth -= hole.q) {
        hole.feed(depth);
        if (!break_chips_only) {
            hole.rapid(hole.r);
        }
        hole.rapid(depth + clearance);
    }
    hole.feed(hole.bottom);
    hole.rapid(hole.clear);
}

void tap(const Hole& hole, bool right_handed) {
    CanonQueue& out = hole.run.out;
    const bool feed_override = hole.run.feed_override_enabled;
    const bool speed_override = hole.run.state.overrides.speed;
    out.send(CommandKind::disable_feed_override);
    out.send(CommandKind::disable_speed_override);
    hole.feed(hole.bottom);
    hole.stop_spindle();
    hole.turn_spindle(!right_handed);
    hole.dwell();
    hole.feed(hole.clear);
    hole.stop_spindle();
    hole.turn_spindle(right_handed);
    if (feed_override) {
        out.send(CommandKind::enable_feed_override);
    }
    if (speed_override) {
        out.send(CommandKind::enable_speed_override);
    }
}

void bore_back(const Hole& hole) {
    const int direction = hole.clockwise() ? 2 : 3; // CANON_CLOCKWISE, CANON_COUNTERCLOCKWISE
    const auto orient = [&] {
        hole.stop_spindle();
        hole.run.out.send(command_of(CommandKind::orient_spindle, direction, 0.0));
    };
    hole.rapid_aside(hole.r);
    orient();
    hole.rapid_aside(hole.bottom);
    hole.rapid(hole.bottom);
    hole.turn_spindle(hole.clockwise());
    hole.feed(hole.middle);
    hole.feed(hole.bottom);
    orient();
    hole.rapid_aside(hole.bottom);
    hole.rapid_aside(hole.clear);
    hole.rapid(hole.clear);
    hole.turn_spindle(hole.clockwise());
}

void drill(const Hole& hole, int motion) {
    switch (motion) {
    case 730:
    case 830:
        peck(hole, motion == 730);
        return;
    case 740:
    case 840:
        tap(hole, motion == 840);
        return;
    case 870:
        bore_back(hole);
        return;
    default:
        break;
    }
    hole.feed(hole.bottom);
    if (motion == 820 || motion == 860 || motion == 880 || motion == 890) {
        hole.dwell();
    }
    if (motion == 850) {
        hole.feed(hole.r);
    }
    if (motion == 890) {
        hole.feed(hole.clear);
    }
    if (motion == 860 || motion == 880) {
        hole.stop_spindle();
    }
    if (motion == 880) {
        hole.run.out.send(CommandKind::program_stop); // the operator retracts
    }
    if (motion == 810 || motion == 820 || motion == 850 || motion == 860) {
        hole.rapid(hole.clear);
    }
    if (motion == 860 || motion == 880) {
        hole.turn_spindle(hole.clockwise());
    }
}

void check_spindle(const ModalState& s, int motion, int column) {
    const bool needs_spindle =
        motion == 740 || motion == 840 || motion == 860 || motion == 870 || motion == 880;
    if (!needs_spindle) {
        return;
    }
    if (s.spindle == SpindleTurning::stopped) {
        refuse(column, fmt::format("{} needs a running spindle", g_name(motion)));
    }
    const bool clockwise = s.spindle == SpindleTurning::clockwise;
    if ((motion == 740 && clockwise) || (motion == 840 && !clockwise)) {
        refuse(column, fmt::format("{} needs the opposite spindle direction", g_name(motion)));
    }
}

char letter_of(Axis axis) {
    return axis_letters[static_cast<std::size_t>(axis)];
}

/// I, J and K go with X, Y and Z (and with U, V and W).
char offset_letter(Axis axis) {
    return static_cast<char>('I' + static_cast<int>(axis) % 3);
}

void check_cycle_words(const Block& block, const ModalState& s, int motion, const PlaneAxes& axes) {
    const int column = block.column_of(GGroup::motion);
    const bool first_of_its_kind = s.motion != motion;
    const std::string name = g_name(motion);
    const bool uvw = s.plane > Plane::yz;
    if (block.has_any(uvw ? words_of("XYZ") : words_of("UVW"))) {
        refuse(column,
               fmt::format("{} can only move the axes of the active plane and the axis perpendicular to it",
                           name));
    }
    if (!first_of_its_kind) {
        return;
    }
    const auto expect = [&](char letter) {
        if (!block.has(letter)) {
            refuse(column, fmt::format("{} needs {} when the cycle starts", name, letter));
        }
    };
    expect('R');
    expect(letter_of(axes.third));
    if (motion == 730 || motion == 830) {
        expect('Q');
    }
    if (motion == 820 || motion == 860 || motion == 880 || motion == 890) {
        expect('P');
    }
    if (motion == 870) {
        expect('I');
        expect('J');
        expect('K');
    }
}

void check_modes(const Block& block, const ModalState& s) {
    const int column = block.column_of(GGroup::motion);
    if (s.feed_mode == FeedMode::inverse_time) {
        refuse(column, "canned cycles cannot be used with inverse time feed (G93)");
    }
    if (exactly_equal(s.feed_rate, 0.0)) {
        refuse(column, "the feed rate of a canned cycle is zero", "set the feed rate with F");
    }
    if (s.cutter.on()) {
        refuse(column, "canned cycles cannot be used with cutter compensation");
    }
    if (block.has('L') && !(block['L'] >= 1.0)) {
        refuse(block.column_of('L'), "the repeat count L of a canned cycle must be at least 1");
    }
}

/// The words of the line over those of the last cycle.
void remember_words(const Block& block, CycleMemory& memory, const PlaneAxes& axes) {
    memory.bottom = block.value_or(letter_of(axes.third), memory.bottom);
    memory.r = block.value_or('R', memory.r);
    memory.p = block.value_or('P', memory.p);
    memory.q = block.value_or('Q', memory.q);
    memory.i = block.value_or('I', memory.i);
    memory.j = block.value_or('J', memory.j);
    memory.k = block.value_or('K', memory.k);
}

double remembered_offset(const CycleMemory& memory, Axis axis) {
    switch (offset_letter(axis)) {
    case 'I':
        return memory.i;
    case 'J':
        return memory.j;
    default:
        return memory.k;
    }
}

/// The heights of the cycle, and whether the tool has to rise to R first.
Hole hole_of(Run& run, const PlaneAxes& axes, double initial) {
    const CycleMemory& memory = run.state.cycle;
    const bool incremental = run.state.distance == DistanceMode::incremental;
    const double r = memory.r + (incremental ? initial : 0.0);
    Hole hole{run, axes, r, 0.0, memory.bottom + (incremental ? r : 0.0)};
    hole.clear = run.state.cycle_return == CycleReturn::r_level || initial < r ? r : initial;
    hole.p = memory.p;
    hole.q = memory.q;
    hole.offset_1 = remembered_offset(memory, axes.first);
    hole.offset_2 = remembered_offset(memory, axes.second);
    hole.middle = remembered_offset(memory, axes.third) + (incremental ? hole.bottom : 0.0);
    return hole;
}

/// At most, with the way to the hole and down to R.
double moves_of_a_hole(const Hole& hole, int motion) {
    constexpr double to_the_hole = 2.0;
    const bool pecks = motion == 730 || motion == 830;
    if (pecks) {
        const double of_a_peck = motion == 730 ? 2.0 : 3.0;
        return to_the_hole + of_a_peck * std::ceil((hole.r - hole.bottom) / hole.q) + 2.0;
    }
    const double down_and_up = motion == 870 ? 8.0 : motion == 850 ? 3.0 : motion == 880 ? 1.0 : 2.0;
    return to_the_hole + down_and_up;
}

void repeat(const Hole& hole, const Block& block, int motion) {
    ModalState& s = hole.run.state;
    const int count = static_cast<int>(block.value_or('L', 1.0));
    double height = std::max(s.position[hole.axes.third], hole.r);
    for (int n = 0; n < count; ++n) {
        const AxisValues at = end_of_move(block, s);
        s.position[hole.axes.first] = at[hole.axes.first];
        s.position[hole.axes.second] = at[hole.axes.second];
        hole.rapid(height);
        if (!exactly_equal(height, hole.r)) {
            hole.rapid(hole.r);
        }
        drill(hole, motion);
        height = hole.clear;
    }
    s.position[hole.axes.third] = hole.clear;
}

} // namespace

void make_cycle(Run& run, Block& block, int motion) {
    ModalState& s = run.state;
    const PlaneAxes axes = axes_of(s.plane);
    const int column = block.column_of(GGroup::motion);
    check_modes(block, s);
    check_cycle_words(block, s, motion, axes);
    CycleMemory memory = s.cycle;
    remember_words(block, memory, axes);
    if (!memory.initial_level_set) {
        memory.initial_level = s.position[axes.third];
        memory.initial_level_set = true;
    }
    s.cycle = memory;
    const Hole hole = hole_of(run, axes, memory.initial_level);
    if (hole.r < hole.bottom) {
        refuse(block.column_of('R'), fmt::format("R of {} is below the bottom of the hole", g_name(motion)));
    }
    if ((motion == 730 || motion == 830) && !(hole.q > 0.0)) {
        refuse(block.column_of('Q'), fmt::format("Q of {} must be greater than 0", g_name(motion)));
    }
    check_spindle(s, motion, column);
    constexpr double up_to_r = 1.0;
    run.out.expect_room_for(up_to_r + std::floor(block.value_or('L', 1.0)) * moves_of_a_hole(hole, motion));
    if (memory.initial_level < hole.r) {
        s.position[axes.third] = hole.r;
        hole.rapid(hole.r);
    }
    go_exactly(run);
    repeat(hole, block, motion);
    go_as_before(run);
    s.motion = motion;
}

} // namespace millwright::gcode::internal
