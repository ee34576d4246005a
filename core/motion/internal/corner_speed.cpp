#include "core/motion/internal/corner_speed.h"

#include "core/base/units.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::motion::internal {

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
