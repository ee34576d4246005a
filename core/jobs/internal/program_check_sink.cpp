#include "core/jobs/internal/program_check_sink.h"

#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace millwright::jobs::internal {

namespace {

using gcode::AxisValues;
using gcode::Command;
using gcode::CommandKind;
using gcode::Move;
using gcode::MoveKind;

constexpr double still = 1e-9; // mm or rad: less is no motion
constexpr double seconds_per_minute = 60.0;
constexpr double most_turns_of_path = 50.0; // of one arc: of more, one is kept

} // namespace

void ProgramCheckSink::move(const Move& move, const gcode::SourceLine&) {
    const AxisValues begin = frame_.from_machine(at_);
    const bool cuts = move.kind != MoveKind::traverse && move.kind != MoveKind::probe;
    if (cuts) {
        cut(move.source.line);
    }
    found_.probes = found_.probes || move.kind == MoveKind::probe;
    if (move.kind == MoveKind::arc) {
        take_arc(begin, move);
    }
    go(move.target, move.source.line, cuts);
}

void ProgramCheckSink::curve(const gcode::Curve& curve, const gcode::SourceLine&) {
    cut(curve.source.line);
    AxisValues point = frame_.from_machine(at_);
    for (const gcode::ControlPoint& corner : curve.points) { // the curve lies within their hull
        point[gcode::Axis::x] = corner.x;
        point[gcode::Axis::y] = corner.y;
        go(point, curve.source.line, true);
    }
}

void ProgramCheckSink::command(const Command& command, const gcode::SourceLine&) {
    frame_.command(command);
    switch (command.kind) {
    case CommandKind::set_feed_rate:
        take_feed(command);
        break;
    case CommandKind::set_spindle_speed:
        found_.greatest_spindle_rpm = std::max(found_.greatest_spindle_rpm, command.value);
        break;
    case CommandKind::start_spindle_clockwise:
    case CommandKind::start_spindle_counterclockwise:
        turning_ = true;
        break;
    case CommandKind::stop_spindle_turning:
        turning_ = false;
        break;
    case CommandKind::select_tool:
        if (std::ranges::find(found_.tools, command.index) == found_.tools.end()) {
            found_.tools.push_back(command.index);
        }
        break;
    default:
        break;
    }
}

void ProgramCheckSink::cut(int line) {
    if (found_.first_cut_line == 0) {
        found_.first_cut_line = line;
        found_.spindle_before_cut = turning_;
    }
    widen(found_.cuts, line);
}

void ProgramCheckSink::take_feed(const Command& command) {
    const double feed = command.value * frame_.unit() / seconds_per_minute;
    if (feed > found_.greatest_feed) {
        found_.greatest_feed = feed;
        found_.greatest_feed_line = command.source.line;
    }
}

void ProgramCheckSink::go(const AxisValues& target, int line, bool cuts) {
    const double z_before = at_[gcode::Axis::z];
    at_ = frame_.to_machine(target);
    const double z = at_[gcode::Axis::z];
    const bool other_z = std::abs(z - z_before) > still;
    const ProgramCheck::Range& range = found_.ranges[static_cast<std::size_t>(gcode::Axis::z)];
    knows_height_ = knows_height_ || (other_z && !cuts) || (!range.empty() && z > range.min + still);
    if (keep_path_) {
        using gcode::Axis;
        found_.path.push_back({line, Vec3(at_[Axis::x], at_[Axis::y], at_[Axis::z])});
    }
    widen(found_.ranges, line);
    if (cuts) {
        widen(found_.cuts, line);
    }
}

/// By where the machine is.
void ProgramCheckSink::widen(std::array<ProgramCheck::Range, gcode::axis_count>& ranges, int line) const {
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const double value = gcode::is_rotary(n) ? from_degrees(at_[n]) : at_[n];
        ProgramCheck::Range& range = ranges[n];
        if (range.moved_line == 0 && std::abs(value) > still) {
            range.moved_line = line;
        }
        if (value < range.min) {
            range.min = value;
            range.min_line = line;
        }
        if (value > range.max) {
            range.max = value;
            range.max_line = line;
        }
    }
}

/// In their order along the arc, among them those where it comes farthest along the axes of its plane.
void ProgramCheckSink::take_arc(const AxisValues& begin, const Move& move) {
    using gcode::Axis;
    using gcode::Plane;
    const auto [first, second] = move.plane == Plane::xz   ? std::pair{Axis::z, Axis::x}
                                 : move.plane == Plane::yz ? std::pair{Axis::y, Axis::z}
                                                           : std::pair{Axis::x, Axis::y};
    const double x = begin[first] - move.centre_1;
    const double y = begin[second] - move.centre_2;
    const double radius = std::hypot(x, y);
    const double from = std::atan2(y, x);
    constexpr double quarter = 0.5 * std::numbers::pi;
    constexpr double step = quarter / 16.0; // the quarters themselves, and near enough where XY is turned
    // One turn has all extents; a path that is kept has more of them, as long as they are few.
    const double most = (keep_path_ ? most_turns_of_path : 1.0) * 4.0 * quarter;
    const double sweep = std::abs(move.sweep) > most ? std::copysign(4.0 * quarter, move.sweep) : move.sweep;
    const double sense = std::copysign(1.0, sweep);
    for (double n = std::floor(sense * from / step) + 1.0; n * step < sense * from + std::abs(sweep); ++n) {
        const double angle = sense * n * step;
        const double part = (angle - from) / move.sweep;
        AxisValues point = begin;
        for (std::size_t axis = 0; axis < gcode::axis_count; ++axis) {
            point[axis] += part * (move.target[axis] - begin[axis]);
        }
        point[first] = move.centre_1 + radius * std::cos(angle);
        point[second] = move.centre_2 + radius * std::sin(angle);
        go(point, move.source.line, true);
    }
}

} // namespace millwright::jobs::internal
