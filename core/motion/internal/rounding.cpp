#include "core/motion/internal/rounding.h"

#include "core/base/numbers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::motion::internal {

namespace {

using kinematics::AxisKind;
using kinematics::AxisPositions;

constexpr double off_the_corner = 3.0 / 16.0;          // the integral of w over half of the rounding, of 2 d
constexpr double most_second = 0.75;                   // of w' / (2 d), times d
constexpr double most_third = 1.5;                     // of w'' / (2 d)^2, times d^2
constexpr double most_turn_of_rounding = 0.5;          // rad by which rotary axes may turn on half a rounding
const double growth = std::exp(most_turn_of_rounding); // of distances from rotary axes meanwhile

constexpr std::array rounding_steps{1e-4, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0,
                                    5.0,  10.0, 20.0, 50.0, 100., 200., 500., 1e3, 2e3, 5e3, 1e4}; // mm

/// How much moves in a direction: all that bounds the curvature of the tip's path.
struct Amount {
    double linear = 0.0; ///< mm
    double rotary = 0.0; ///< rad
};

Amount amount(const Mechanism& machine, const AxisPositions& direction) {
    Amount sum;
    for (int n = 0; n < machine.axis_count(); ++n) {
        (machine.axis(n).kind == AxisKind::rotary ? sum.rotary : sum.linear) += std::abs(direction[n]);
    }
    return sum;
}

/// A bound of the tip's second derivative in two directions. `radius`: from the tip to any rotary axis.
double bend(const Amount& a, const Amount& b, double radius) {
    return a.rotary * b.rotary * radius + a.rotary * b.linear + a.linear * b.rotary;
}

/// d so that off * d * (a + b * d) is `tolerance`.
double length_within(double tolerance, double a, double b) {
    const double wanted = tolerance / off_the_corner;
    const double root = std::sqrt(a * a + 4.0 * b * wanted);
    return a + root > 0.0 ? 2.0 * wanted / (a + root) : std::numeric_limits<double>::infinity();
}

double length_with_rotary(const Mechanism& machine,
                          const Corner& corner,
                          const AxisPositions& change,
                          const RoundingTolerance& tolerance,
                          double longest) {
    const kinematics::Jacobian J = machine.jacobian(corner.position);
    double radius = 0.0;
    double turns = 0.0;
    for (int n = 0; n < machine.axis_count(); ++n) {
        if (machine.axis(n).kind == AxisKind::rotary) {
            radius = std::max(radius, J.col(n).head<3>().norm());
            turns = std::max(turns, std::abs(change[n]));
        }
    }
    const Amount before = amount(machine, corner.before);
    const Amount after = amount(machine, corner.after);
    const Amount along{std::max(before.linear, after.linear), std::max(before.rotary, after.rotary)};
    const Amount across = amount(machine, change);
    double d = longest;
    if (along.rotary > 0.0) {
        d = std::min(d, most_turn_of_rounding / along.rotary);
    }
    if (turns > 0.0) {
        d = std::min(d, tolerance.angle / (off_the_corner * turns));
    }
    const double farthest = growth * (radius + d * along.linear);
    const double straight = (J.topRows<3>() * change).norm();
    const double curved =
        bend(across, along, farthest) + 0.5 * off_the_corner * bend(across, across, farthest);
    return std::min(d, length_within(tolerance.tip, straight, curved));
}

} // namespace

double rounding_step(double tolerance) {
    constexpr double same = 1.0 + 1e-9; // products of ten, and of inches
    const auto above = std::ranges::upper_bound(rounding_steps, tolerance * same);
    return above == rounding_steps.begin() ? 0.0 : *(above - 1);
}

double next_rounding_step(double step) {
    const auto above = std::ranges::upper_bound(rounding_steps, step);
    return above == rounding_steps.end() ? std::numeric_limits<double>::infinity() : *above;
}

// First order at the corner, and what the second derivatives can add between the corner and the place (`d`
// away at most) and from the place to the rounding (3/16 d |change| away at most).
double rounding_length(const Mechanism& machine,
                       const Corner& corner,
                       const RoundingTolerance& tolerance,
                       double longest) {
    const AxisPositions change = corner.after - corner.before;
    const bool turns = std::ranges::any_of(machine.rotary_axes(), [&](int n) {
        return std::abs(corner.before[n]) > 0.0 || std::abs(corner.after[n]) > 0.0;
    });
    if (turns) {
        return length_with_rotary(machine, corner, change, tolerance, longest);
    }
    return std::min(longest, length_within(tolerance.tip, machine.sliding(corner.position, change), 0.0));
}

// With the way s(t): velocity = q' s', acceleration = q'' s'^2 + q' s'', jerk = q''' s'^3 + 3 q'' s' s'' +
// q' s''', where |q''| <= 0.75 |change| / d, |q'''| <= 1.5 |change| / d^2, q' is between both directions and
// the filter keeps |s'''| <= 2 |s''| / filter_time.
RoundingLimits rounding_limits(const Mechanism& machine,
                               const std::vector<AxisLimits>& limits,
                               const Corner& corner,
                               double d,
                               double fastest,
                               double filter_time,
                               double turning_share) {
    RoundingLimits result;
    result.speed = fastest;
    result.speed_cause = {Limit::programmed_feed, -1};
    const double path_second = most_second * machine.linear_length(corner.after - corner.before) / d;
    if (path_second * square(result.speed) > turning_share * corner.acceleration) {
        result.speed = std::sqrt(turning_share * corner.acceleration / path_second);
        result.speed_cause = {Limit::corner, -1};
    }
    const auto axes = static_cast<int>(limits.size());
    const auto bend_of = [&](int n) {
        return std::abs(corner.after[n] - corner.before[n]) /
               limits[static_cast<std::size_t>(n)].acceleration;
    };
    const auto jerk_of = [&](int n) {
        const AxisLimits& axis = limits[static_cast<std::size_t>(n)];
        return axis.jerk / axis.acceleration;
    };
    for (int n = 0; n < axes; ++n) {
        const double second = most_second * bend_of(n) / d;
        const double third = most_third * bend_of(n) / square(d);
        if (second * square(result.speed) > turning_share) {
            result.speed = std::sqrt(turning_share / second);
            result.speed_cause = {Limit::corner, static_cast<std::int8_t>(n)};
        }
        if (third * square(result.speed) * result.speed > turning_share * jerk_of(n)) {
            result.speed = std::cbrt(turning_share * jerk_of(n) / third);
            result.speed_cause = {Limit::corner, static_cast<std::int8_t>(n)};
        }
    }
    const double path_along =
        std::max(machine.linear_length(corner.before), machine.linear_length(corner.after));
    result.acceleration = path_along > 0.0
                              ? (corner.acceleration - path_second * square(result.speed)) / path_along
                              : std::numeric_limits<double>::infinity();
    result.acceleration_cause = {Limit::axis_acceleration, -1};
    const auto keep = [&](double acceleration, int n) {
        if (acceleration < result.acceleration) {
            result.acceleration = acceleration;
            result.acceleration_cause = {Limit::axis_acceleration, static_cast<std::int8_t>(n)};
        }
    };
    for (int n = 0; n < axes; ++n) {
        const double along = std::max(std::abs(corner.before[n]), std::abs(corner.after[n])) /
                             limits[static_cast<std::size_t>(n)].acceleration;
        if (!(along > 0.0)) {
            continue;
        }
        const double second = most_second * bend_of(n) / d;
        const double third = most_third * bend_of(n) / square(d);
        keep((1.0 - second * square(result.speed)) / along, n);
        if (filter_time > 0.0 && std::isfinite(jerk_of(n))) {
            const double left = jerk_of(n) - third * square(result.speed) * result.speed;
            keep(left / (3.0 * second * result.speed + 2.0 * along / filter_time), n);
        }
    }
    return result;
}

} // namespace millwright::motion::internal
