// The way of the axes through a program, before any timing. Each block is straight in axis space. Axis
// positions are divided by the axis's greatest acceleration, so that millimetres and radians can be added:
// the scaled length of a block is the Euclidean length there (unit s^2), a scaled speed is its change in time
// (unit s), a scaled acceleration is a plain number, and every axis may accelerate by 1.
#pragma once

#include "core/kinematics/machine_model.h"

#include <vector>

namespace millwright::motion {

/// What keeps a block from being faster.
enum class Limit {
    standing,          ///< no motion: dwell, spindle, comment
    programmed_feed,   ///< the time that the program asks for
    axis_velocity,     ///< an axis at its top speed
    axis_acceleration, ///< the block is too short to reach any other limit
};

/// One block. Scaled lengths, speeds and accelerations.
struct Segment {
    double length = 0.0;           ///< 0: no motion
    double standing_time = 0.0;    ///< of a dwell, s
    double max_speed = 0.0;        ///< by feed and axis velocities
    double max_acceleration = 0.0; ///< by axis accelerations
    double max_start_speed = 0.0;  ///< by the corner at its beginning
    int velocity_axis = -1;        ///< whose velocity sets max_speed; -1: the programmed feed does
    int acceleration_axis = -1;    ///< whose acceleration sets max_acceleration
};

struct Path {
    std::vector<kinematics::AxisPositions> positions; ///< before each block, and after the last: blocks + 1
    std::vector<Segment> segments;                    ///< one a block
    std::vector<double> part_length; ///< chords of the tip on the part up to each of `positions`, mm

    [[nodiscard]] int block_count() const { return static_cast<int>(segments.size()); }
};

} // namespace millwright::motion
