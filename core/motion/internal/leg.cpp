#include "core/motion/internal/leg.h"

#include "core/motion/internal/part_speed.h"
#include "core/motion/override.h"

#include <algorithm>
#include <cmath>

namespace millwright::motion::internal {

namespace {

using kinematics::AxisPositions;

void set_axis_limits(Leg& leg, const std::vector<AxisLimits>& limits) {
    leg.speed = leg.acceleration = std::numeric_limits<double>::infinity();
    for (int n = 0; n < static_cast<int>(limits.size()); ++n) {
        const double share = std::abs(leg.unit[n]);
        if (!(share > 0.0)) {
            continue;
        }
        const AxisLimits& axis = limits[static_cast<std::size_t>(n)];
        const auto letter = static_cast<std::int8_t>(n);
        const double speed = axis.velocity / axis.acceleration / share;
        if (speed < leg.speed) {
            leg.speed = speed;
            leg.speed_cause = {Limit::axis_velocity, letter};
        }
        if (1.0 / share < leg.acceleration) {
            leg.acceleration = 1.0 / share;
            leg.acceleration_cause = {Limit::axis_acceleration, letter};
        }
    }
    leg.axis_speed = leg.speed;
}

/// In scaled axes.
AxisPositions scaled_step(const std::vector<AxisLimits>& limits, AxisPositions step) {
    for (int n = 0; n < static_cast<int>(limits.size()); ++n) {
        step[n] /= limits[static_cast<std::size_t>(n)].acceleration;
    }
    return step;
}

void set_path_acceleration(Leg& leg, const Mechanism& machine, double path_acceleration) {
    leg.path_acceleration = path_acceleration;
    const double length = machine.linear_length(leg.direction);
    if (leg.acceleration * length > path_acceleration) {
        leg.acceleration = path_acceleration / length;
        leg.acceleration_cause = {Limit::axis_acceleration, -1};
    }
}

void set_feed(Leg& leg,
              const Mechanism& machine,
              const PlannerSettings& settings,
              const program::Block& block,
              const AxisPositions& from,
              const AxisPositions& to) {
    const double top = leg.speed;
    if (leg.rapid) {
        leg.feed = {{leg.length, top}};
        return;
    }
    if (settings.feed_rule == FeedRule::on_part && block.feed > 0.0) {
        leg.feed = part_speeds(machine, {from, to, leg.length}, block.feed);
    } else {
        const bool timed = block.duration > 0.0;
        leg.feed = {{leg.length, timed ? leg.length / block.duration : top}};
    }
    double fastest = 0.0;
    for (FeedStep& step : leg.feed) {
        step.speed = std::min(step.speed, top);
        fastest = std::max(fastest, step.speed);
    }
    if (highest_override * fastest < top) {
        leg.speed = highest_override * fastest;
        leg.speed_cause = {Limit::programmed_feed, -1};
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

Leg leg_of(const Mechanism& machine,
           const std::vector<AxisLimits>& limits,
           const PlannerSettings& settings,
           const program::Block& block,
           const AxisPositions& from,
           const AxisPositions& to,
           double path_acceleration) {
    Leg leg;
    const AxisPositions step = to - from;
    leg.unit = scaled_step(limits, step);
    leg.length = leg.unit.norm();
    leg.unit /= leg.length;
    leg.direction = step / leg.length;
    leg.rapid = block.kind == program::BlockKind::rapid;
    leg.path = block.path.value_or(settings.path);
    set_axis_limits(leg, limits);
    set_path_acceleration(leg, machine, path_acceleration);
    set_feed(leg, machine, settings, block, from, to);
    return leg;
}

} // namespace millwright::motion::internal
