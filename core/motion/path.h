// The way of the axes through a program, before any timing. Axis positions are divided by the axis's greatest
// acceleration, so that millimetres and radians can be added: the scaled length of a block is the Euclidean
// length there (unit s^2), a scaled speed is its change in time (unit s), a scaled acceleration is a plain
// number, and every axis may accelerate by 1.
//
// Each block is straight in axis space; a corner may be rounded between two points that are equally far from
// it. The *way* is the scaled length of the programmed, unrounded blocks: on a rounding the axes are at
// Path::at(way) all the same, and blocks meet in its middle.
#pragma once

#include "core/kinematics/machine_model.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace millwright::motion {

/// What keeps a motion from being faster.
enum class Limit : std::uint8_t {
    standing,          ///< no motion: dwell, spindle, comment
    programmed_feed,   ///< the time or the speed that the program asks for, and overrides
    axis_velocity,     ///< an axis at its top speed
    axis_acceleration, ///< an axis that speeds up or slows down as fast as it can
    axis_jerk,         ///< an axis whose acceleration may not change faster
    corner             ///< the speed through a corner, or on its rounding
};

/// A limit and the axis that it belongs to, -1 if to no axis.
struct Cause {
    Limit limit = Limit::standing;
    std::int8_t axis = -1;

    friend bool operator==(const Cause&, const Cause&) = default;
};

/// One block.
struct Segment {
    double start = 0.0;          ///< way up to its start
    double length = 0.0;         ///< 0: no motion
    double standing_time = 0.0;  ///< of a dwell, s
    double rounding_start = 0.0; ///< scaled length that belongs to the rounding at its start
    double rounding_end = 0.0;   ///< and at its end
    int before = -1, after = -1; ///< the moves whose directions the roundings join; of no move: the last one

    [[nodiscard]] double end() const { return start + length; }
};

/// A value that holds up to `end` of the way, from the end of the step before.
struct Step {
    double end = 0.0;
    double value = 0.0;
    Cause cause;
};

/// A limit as a function of the way: constant in steps. One of no length is a limit at one point.
using Profile = std::vector<Step>;

/// The speed that a program asks for, in steps as a Profile.
struct ProgrammedStep {
    double end = 0.0;
    double speed = 0.0; ///< scaled
    bool rapid = false; ///< `speed` is the top speed of the axes
    bool rests = false; ///< the axes rest at its end
};

struct AxisLimits {
    double velocity = 0.0, acceleration = 0.0;
    double jerk = std::numeric_limits<double>::infinity();
};

/// Axis positions and their derivatives by the way.
struct PathDerivatives {
    kinematics::AxisPositions position, first, second, third;
};

struct Path {
    std::vector<AxisLimits> limits;                   ///< of each axis
    std::vector<kinematics::AxisPositions> positions; ///< programmed, before each block and after the last
    std::vector<Segment> segments;                    ///< one per block
    std::vector<double> part_length;        ///< chords of the tip on the part up to each of `positions`, mm
    double filter_time = 0.0;               ///< s, see trajectory.h; 0 without limits of jerk
    int look_ahead = 0;                     ///< moves that are known at a time; 0: all
    Profile speed;                          ///< that the axes allow; 0 where they have to stop
    Profile acceleration;                   ///< that they allow along the way
    std::vector<ProgrammedStep> programmed; ///< speeds that the program asks for

    [[nodiscard]] int block_count() const { return static_cast<int>(segments.size()); }
    [[nodiscard]] double length() const { return segments.empty() ? 0.0 : segments.back().end(); }
    /// `offset` into the way of a block, 0 to its length: exactly a programmed position at both ends, unless
    /// the corner is rounded.
    [[nodiscard]] PathDerivatives at(int block, double offset) const;
};

} // namespace millwright::motion
