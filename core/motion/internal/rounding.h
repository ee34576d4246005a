// Roundings of corners: how large they may be and how fast they can be gone through. Between two points at
// the scaled distance d from the corner the direction turns from that of one block to that of the other by
// w(u) = 3 u^2 - 2 u^3 with the share u of the way; no point is further from its place on the programmed
// path than 3/16 d |change of direction| (docs/reference/motion.md#roundings).
#pragma once

#include "core/motion/internal/mechanism.h"
#include "core/motion/planner.h"

#include <limits>
#include <vector>

namespace millwright::motion::internal {

/// Two straight ways that meet. Directions by the scaled way, in axis units: mm, rad.
struct Corner {
    kinematics::AxisPositions position;
    kinematics::AxisPositions before, after;
    double acceleration = std::numeric_limits<double>::infinity(); ///< of the linear axes together, mm/s2
};

struct RoundingTolerance {
    double tip = 0.0;   ///< mm
    double angle = 0.0; ///< of each rotary axis, rad
};

/// The largest of 1e-4, 1e-3, 2e-3, 5e-3, 0.01 ... mm that is not above `tolerance`; 0 below the first. With
/// steps that are the same for every program, what may be chosen under a tolerance may be chosen under a
/// larger one.
[[nodiscard]] double rounding_step(double tolerance);
/// The first above `step`.
[[nodiscard]] double next_rounding_step(double step);

/// The greatest d that keeps the tip on the part within its tolerance of where it would be on the programmed
/// path, and each rotary axis within its own; at most `longest`.
[[nodiscard]] double rounding_length(const Mechanism& machine,
                                     const Corner& corner,
                                     const RoundingTolerance& tolerance,
                                     double longest);

/// What of each axis's acceleration and jerk the turning on a rounding may take; the rest is for the motion
/// along it.
inline constexpr double usual_turning_share = 0.75;
/// Where one rounding follows the other the speed hardly changes, and this is faster.
inline constexpr double greatest_turning_share = 0.95;

/// Of the roundings of a part of the way.
struct RoundingBounds {
    double tolerance = std::numeric_limits<double>::infinity(); ///< mm; 0: corners are met at rest
    double turning_share = usual_turning_share;
};

/// Speed and acceleration along the way that keep all axes within their limits on a rounding.
struct RoundingLimits {
    double speed = 0.0;
    double acceleration = 0.0;
    Cause speed_cause, acceleration_cause;
};

/// `fastest` is what the blocks themselves allow; `filter_time` as in Path.
[[nodiscard]] RoundingLimits rounding_limits(const Mechanism& machine,
                                             const std::vector<AxisLimits>& limits,
                                             const Corner& corner,
                                             double d,
                                             double fastest,
                                             double filter_time,
                                             double turning_share);

} // namespace millwright::motion::internal
