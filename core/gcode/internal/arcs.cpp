#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/compensation.h"
#include "core/gcode/internal/motions.h"
#include "core/gcode/internal/plane_geometry.h"
#include "core/gcode/internal/refusal.h"
#include "core/gcode/internal/targets.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::gcode::internal {

namespace {

/// More turns than this are taken for a mistake.
constexpr double most_turns = 100'000.0;

/// The letters of the centre's words along the plane's axes, and the one that must not stand.
struct CentreWords {
    char first, second, across;
};

CentreWords centre_words(Plane plane) {
    switch (plane) {
    case Plane::xz:
        return {'K', 'I', 'J'};
    case Plane::yz:
        return {'J', 'K', 'I'};
    default:
        return {'I', 'J', 'K'};
    }
}

void expect_one_form(const Block& block, const ModalState& s, Dialect dialect) {
    const int column = block.column_of(GGroup::motion);
    const bool by_centre = block.has_any(words_of("IJK"));
    if (!block.has('R') && !by_centre) {
        refuse(column, "an arc needs its centre (I J K) or its radius (R)");
    }
    if (block.has('R') && by_centre) {
        refuse(block.column_of('R'), "an arc needs either a centre (I J K) or a radius (R), not both");
    }
    const CentreWords words = centre_words(s.plane);
    if (by_centre && block.has(words.across) && dialect != Dialect::grbl) {
        refuse(block.column_of(words.across),
               fmt::format(
                   "{} is not allowed for an arc in the {} plane", words.across, plane_letters(s.plane)));
    }
    if (by_centre && s.arc_distance == DistanceMode::absolute &&
        !(block.has(words.first) && block.has(words.second))) {
        refuse(column,
               fmt::format(
                   "with absolute centres (G90.1) an arc needs both {} and {}", words.first, words.second));
    }
    const PlaneAxes axes = axes_of(s.plane);
    const char first = axis_letters[static_cast<std::size_t>(axes.first)];
    const char second = axis_letters[static_cast<std::size_t>(axes.second)];
    if (!by_centre && !block.has(first) && !block.has(second) && !block.polar()) {
        refuse(column, fmt::format("an arc given by its radius needs {} or {}", first, second));
    }
}

int turns_of(const Block& block, int motion) {
    const double turns = std::round(block.value_or('P', 1.0));
    if (turns > most_turns) {
        refuse(block.column_of('P'), fmt::format("an arc may have at most {:.0f} turns", most_turns));
    }
    constexpr int clockwise = 20;
    return motion == clockwise ? -static_cast<int>(turns) : static_cast<int>(turns);
}

/// Programs of other controls give centres in coordinates of the work.
bool is_circle_about_absolute_centre(const Block& block,
                                     const ModalState& s,
                                     const Vec2& start,
                                     const Vec2& end,
                                     const Vec2& relative_centre,
                                     const ArcTolerances& within) {
    const CentreWords words = centre_words(s.plane);
    if (s.arc_distance == DistanceMode::absolute || !block.has(words.first) || !block.has(words.second)) {
        return false;
    }
    const auto is_circle = [&](const Vec2& centre) {
        const double at_start = (start - centre).norm();
        const double at_end = (end - centre).norm();
        return at_start >= within.smallest_radius && std::abs(at_start - at_end) <= within.free_difference;
    };
    return !is_circle(relative_centre) && is_circle({block[words.first], block[words.second]});
}

/// Along the helix; LinuxCNC counts the radius at the arc's start.
double arc_length(const Vec2& start, const Vec2& centre, double sweep, double rise) {
    return std::hypot((start - centre).norm() * sweep, rise);
}

} // namespace

void make_arc(Run& run, const Block& block, int motion) {
    ModalState& s = run.state;
    const int column = block.column_of(GGroup::motion);
    if (s.cutter.arc_forbidden) {
        refuse(column, "the move after cutter compensation must be straight, not an arc");
    }
    if (s.plane > Plane::yz) {
        refuse(column, "arcs are not possible in the planes G17.1, G18.1 and G19.1");
    }
    expect_one_form(block, s, run.settings.dialect);
    expect_feed(run, block, motion);
    const AxisValues end = end_of_move(block, s);
    s.motion = motion;

    const PlaneAxes axes = axes_of(s.plane);
    const bool compensated = s.cutter.on() && s.cutter.radius > 0.0;
    const AxisValues& from = compensated && !s.cutter.first_move ? s.programmed : s.position;
    const Vec2 start_2(from[axes.first], from[axes.second]);
    const Vec2 end_2(end[axes.first], end[axes.second]);
    const int turns = turns_of(block, motion);
    const ArcTolerances within = arc_tolerances(s.unit, run.settings.dialect);
    Vec2 centre;
    if (block.has('R')) {
        centre = centre_from_radius(
            start_2, end_2, block['R'], turns, within.smallest_radius, block.column_of('R'));
    } else {
        const CentreWords words = centre_words(s.plane);
        centre = {block.value_or(words.first, 0.0), block.value_or(words.second, 0.0)};
        centre += s.arc_distance == DistanceMode::absolute ? Vec2(Vec2::Zero()) : start_2;
    }
    try {
        check_centre(start_2, end_2, centre, within, s.plane, column);
    } catch (Refusal& refusal) {
        if (is_circle_about_absolute_centre(block, s, start_2, end_2, centre, within)) {
            refusal.hint = run.settings.dialect == Dialect::grbl
                               ? "set the CAM program to incremental centres (G91.1): the centre words are "
                                 "absolute, but Grbl measures from the start of the arc"
                               : "put G90.1 before it: the arc's centre words are absolute";
        }
        throw;
    }
    const double sweep = sweep_of(start_2, end_2, centre, turns);
    set_inverse_time_feed(run, block, arc_length(start_2, centre, sweep, end[axes.third] - from[axes.third]));

    Move move = run.out.new_move(MoveKind::arc);
    move.plane = s.plane;
    move.turns = turns;
    move.target = end;
    move.centre_1 = centre.x();
    move.centre_2 = centre.y();
    move.sweep = sweep;
    if (compensated) {
        compensate_arc(run, move, column);
        return;
    }
    run.out.send(move);
    s.position = end;
}

} // namespace millwright::gcode::internal
