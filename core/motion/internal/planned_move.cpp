#include "core/motion/internal/planned_move.h"

#include "core/motion/internal/part_speed.h"
#include "core/motion/override.h"

#include <algorithm>
#include <cmath>

namespace millwright::motion::internal {

namespace {

using kinematics::AxisPositions;

void set_axis_limits(PlannedMove& move, const std::vector<AxisLimits>& limits) {
    move.speed = move.acceleration = std::numeric_limits<double>::infinity();
    for (int n = 0; n < static_cast<int>(limits.size()); ++n) {
        const double share = std::abs(move.unit[n]);
        if (!(share > 0.0)) {
            continue;
        }
        const AxisLimits& axis = limits[static_cast<std::size_t>(n)];
        const auto letter = static_cast<std::int8_t>(n);
        const double speed = axis.velocity / axis.acceleration / share;
        if (speed < move.speed) {
            move.speed = speed;
            move.speed_cause = {Limit::axis_velocity, letter};
        }
        if (1.0 / share < move.acceleration) {
            move.acceleration = 1.0 / share;
            move.acceleration_cause = {Limit::axis_acceleration, letter};
        }
    }
    move.axis_speed = move.speed;
}

/// In scaled axes.
AxisPositions scaled_step(const std::vector<AxisLimits>& limits, AxisPositions step) {
    for (int n = 0; n < static_cast<int>(limits.size()); ++n) {
        step[n] /= limits[static_cast<std::size_t>(n)].acceleration;
    }
    return step;
}

void set_path_acceleration(PlannedMove& move, const Mechanism& machine, double path_acceleration) {
    move.path_acceleration = path_acceleration;
    const double length = machine.linear_length(move.direction);
    if (move.acceleration * length > path_acceleration) {
        move.acceleration = path_acceleration / length;
        move.acceleration_cause = {Limit::axis_acceleration, -1};
    }
}

void set_feed(PlannedMove& move,
              const Mechanism& machine,
              const PlannerSettings& settings,
              const program::Block& block,
              const AxisPositions& from,
              const AxisPositions& to) {
    const double top = move.speed;
    if (move.rapid) {
        move.feed = {{move.length, top}};
        return;
    }
    if (settings.feed_rule == FeedRule::on_part && block.feed > 0.0) {
        move.feed = part_speeds(machine, {from, to, move.length}, block.feed);
    } else {
        const bool timed = block.duration > 0.0;
        move.feed = {{move.length, timed ? move.length / block.duration : top}};
    }
    double fastest = 0.0;
    for (FeedStep& step : move.feed) {
        step.speed = std::min(step.speed, top);
        fastest = std::max(fastest, step.speed);
    }
    if (highest_override * fastest < top) {
        move.speed = highest_override * fastest;
        move.speed_cause = {Limit::programmed_feed, -1};
    }
}

} // namespace

std::vector<AxisLimits> limits_of(const Mechanism& machine) {
    std::vector<AxisLimits> limits;
    for (const kinematics::MachineAxis& axis : machine.axes()) {
        limits.push_back({axis.max_velocity, axis.max_acceleration, axis.max_jerk});
    }
    return limits;
}

AxisPositions
unit_of(const std::vector<AxisLimits>& limits, const AxisPositions& from, const AxisPositions& to) {
    return scaled_step(limits, to - from).normalized();
}

PlannedMove planned_move_of(const Mechanism& machine,
                            const std::vector<AxisLimits>& limits,
                            const PlannerSettings& settings,
                            const program::Block& block,
                            const AxisPositions& from,
                            const AxisPositions& to,
                            double path_acceleration) {
    PlannedMove move;
    const AxisPositions step = to - from;
    move.unit = scaled_step(limits, step);
    move.length = move.unit.norm();
    move.unit /= move.length;
    move.direction = step / move.length;
    move.rapid = block.kind == program::BlockKind::rapid;
    move.path = block.path.value_or(settings.path);
    set_axis_limits(move, limits);
    set_path_acceleration(move, machine, path_acceleration);
    set_feed(move, machine, settings, block, from, to);
    return move;
}

} // namespace millwright::motion::internal
