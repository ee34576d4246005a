#include "core/motion/internal/planned_move.h"

#include "core/base/units.h"
#include "core/motion/override.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::motion::internal {

namespace {

using kinematics::AxisPositions;

constexpr double wanted_accuracy = 0.02; // of the feed, as far as the number of steps allows
constexpr double longest_turn = 0.1;     // rad a step, as far as the number of steps allows
constexpr int most_steps = 256;

/// How fast a straight way in axis space bends on the part.
struct Bending {
    double linear = 0.0; ///< mm a unit of the way
    double rotary = 0.0; ///< rad a unit of the way

    /// A bound of |d/ds J q'| within `distance` of a place where the tip is `radius` away from the axes.
    [[nodiscard]] double change(double radius, double distance) const {
        const double farthest = (radius + linear * distance) * std::exp(rotary * distance);
        return rotary * (rotary * farthest + 2.0 * linear);
    }
};

Bending bending_of(const Mechanism& machine, const AxisPositions& direction) {
    Bending bending;
    for (int n = 0; n < machine.axis_count(); ++n) {
        const bool rotary = machine.axis(n).kind == kinematics::AxisKind::rotary;
        (rotary ? bending.rotary : bending.linear) += std::abs(direction[n]);
    }
    return bending;
}

struct TipRate {
    double rate = 0.0;   ///< |J q'|: how far the tip goes a unit of the way
    double radius = 0.0; ///< from the tip to the farthest rotary axis
};

TipRate tip_rate(const Mechanism& machine, const AxisPositions& q, const AxisPositions& direction) {
    const kinematics::Jacobian J = machine.jacobian(q);
    TipRate result;
    result.rate = (J.topRows<3>() * direction).norm();
    for (const int n : machine.rotary_axes()) {
        result.radius = std::max(result.radius, J.col(n).head<3>().norm());
    }
    return result;
}

int steps_for(const Bending& bending, const TipRate& first, const TipRate& last, double length) {
    const double change = 0.5 * length * bending.change(std::max(first.radius, last.radius), 0.0);
    const double rate = std::max({first.rate, last.rate, change});
    const double wanted = rate > 0.0 ? change / (wanted_accuracy * rate) : 0.0;
    const double turning = bending.rotary * length / longest_turn;
    return std::max(1, static_cast<int>(std::min<double>(most_steps, std::ceil(std::max(wanted, turning)))));
}

} // namespace

// Between two places the rate is at most their mean and half of the distance times its greatest change.
std::vector<FeedStep> part_speeds(const Mechanism& machine, const StraightWay& way, double feed) {
    const AxisPositions direction = (way.to - way.from) / way.length;
    const Bending bending = bending_of(machine, direction);
    TipRate before = tip_rate(machine, way.from, direction);
    const TipRate last = tip_rate(machine, way.to, direction);
    const int steps = steps_for(bending, before, last, way.length);
    const double length = way.length / steps;
    std::vector<FeedStep> result;
    for (int k = 1; k <= steps; ++k) {
        const double share = static_cast<double>(k) / steps;
        const bool is_last = k == steps;
        const TipRate after =
            is_last ? last : tip_rate(machine, way.from + share * (way.to - way.from), direction);
        const double change = bending.change(std::max(before.radius, after.radius), 0.5 * length);
        const double greatest = 0.5 * (before.rate + after.rate + length * change);
        result.push_back({is_last ? way.length : share * way.length,
                          greatest > 0.0 ? feed / greatest : std::numeric_limits<double>::infinity()});
        before = after;
    }
    return result;
}

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

namespace {

using kinematics::AxisPositions;

constexpr double no_limit = std::numeric_limits<double>::infinity();

/// In a corner each scaled velocity jumps by speed * |change of direction|, allowed is corner_time; that of
/// the linear axes together by what the program's acceleration reaches in that time.
double by_small_step(const Mechanism& machine,
                     const PlannerSettings& settings,
                     const PlannedMove& before,
                     const PlannedMove& after) {
    constexpr double straight = 1e-15; // rounding of a unit vector
    const double turn = (after.unit - before.unit).cwiseAbs().maxCoeff();
    if (!(turn > straight)) {
        return no_limit;
    }
    const double by_axes = settings.corner_time / turn;
    const double most = std::min(before.path_acceleration, after.path_acceleration);
    const double change = machine.linear_length(after.direction - before.direction);
    return change > 0.0 ? std::min(by_axes, settings.corner_time * most / change) : by_axes;
}

/// The direction in mm and degrees, and the speed of a unit of the way in them.
struct PlainDirection {
    AxisPositions unit;
    double length = 0.0;
};

PlainDirection plain(const Mechanism& machine, const PlannedMove& move) {
    PlainDirection result{move.direction, 0.0};
    for (const int n : machine.rotary_axes()) {
        result.unit[n] = to_degrees(result.unit[n]);
    }
    result.length = result.unit.norm();
    result.unit /= result.length;
    return result;
}

/// Grbl 1.1's planner: v^2 = a * deviation * sin(theta/2) / (1 - sin(theta/2)), where theta is the angle
/// between the way back and the way on, and a what the axes can do in the direction of the change.
double by_junction_deviation(const Mechanism& machine,
                             const PlannerSettings& settings,
                             const PlannedMove& before,
                             const PlannedMove& after) {
    constexpr double nearly = 0.999999; // a cosine beyond it: a full turn, or straight on
    const PlainDirection in = plain(machine, before);
    const PlainDirection out = plain(machine, after);
    const double cosine = -in.unit.dot(out.unit);
    if (cosine > nearly) {
        return 0.0;
    }
    if (cosine < -nearly) {
        return no_limit;
    }
    const AxisPositions change = (out.unit - in.unit).normalized();
    double acceleration = std::min(before.path_acceleration, after.path_acceleration);
    for (int n = 0; n < machine.axis_count(); ++n) {
        const kinematics::MachineAxis& axis = machine.axis(n);
        const bool rotary = axis.kind == kinematics::AxisKind::rotary;
        const double most = rotary ? to_degrees(axis.max_acceleration) : axis.max_acceleration;
        const double part = std::abs(change[n]);
        acceleration = part > 0.0 ? std::min(acceleration, most / part) : acceleration;
    }
    const double sine_half = std::sqrt(0.5 * (1.0 - cosine));
    const double speed =
        std::sqrt(acceleration * settings.junction_deviation * sine_half / (1.0 - sine_half));
    return std::min(speed / in.length, speed / out.length);
}

} // namespace

double corner_speed(const Mechanism& machine,
                    const PlannerSettings& settings,
                    const PlannedMove& before,
                    const PlannedMove& after) {
    return settings.corner_rule == CornerRule::small_step
               ? by_small_step(machine, settings, before, after)
               : by_junction_deviation(machine, settings, before, after);
}

} // namespace millwright::motion::internal
