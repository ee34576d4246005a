// Trapezoids in the scaled length of one block: constant acceleration up, cruise, the same acceleration down.
#pragma once

#include "core/motion/trajectory.h"

namespace millwright::motion::internal {

/// The fastest way from `begin` at `start_speed` to `end` at `end_speed`. The speeds must be reachable from
/// each other on this length with `max_acceleration`, and not above `max_speed` (up to rounding).
[[nodiscard]] Piece
trapezoid(const Segment& segment, double begin, double end, double start_speed, double end_speed);

/// Standing still from `begin` to `end` of a dwell, s.
[[nodiscard]] Piece standing(double begin, double end);

/// The top speed after `length` of acceleration from `speed`, and before as much braking down to it.
[[nodiscard]] double speed_after(double speed, double acceleration, double length);

/// Offset, speed and acceleration a `time` into the piece, 0 to its duration.
struct Moment {
    double offset = 0.0;
    double speed = 0.0;
    double acceleration = 0.0;
};
[[nodiscard]] Moment moment(const Piece& piece, const Segment& segment, double time);

/// The time into the piece at which `offset` is reached; clamped to the piece.
[[nodiscard]] double time_of(const Piece& piece, const Segment& segment, double offset);

} // namespace millwright::motion::internal
