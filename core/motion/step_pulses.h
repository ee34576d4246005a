// Step and direction pulses of a trajectory, as a controller's timer would give them out, and how uneven that
// timer makes them.
//
// The motor of an axis stands on whole steps. A pulse is due when the planned position passes the middle
// between two steps, so that the motor is never more than half a step away; times are exact inverses of the
// plan. The timer then gives the pulse at its nearest tick, at least `min_interval` after the one before.
#pragma once

#include "core/base/progress.h"
#include "core/motion/trajectory.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace millwright::motion {

struct StepSettings {
    std::vector<double> steps_per_unit;     ///< of each axis: steps per mm or rad, > 0
    double timer_frequency = 1e6;           ///< Hz
    std::int64_t min_interval = 2;          ///< ticks between two pulses of one axis, >= 1
    double jitter_limit = 0.0;              ///< s: pulses that are off by more are counted; 0: none is
    std::int64_t most_pulses_per_block = 0; ///< of an axis: more is an error; 0: 1000 million
};

struct StepPulse {
    std::int64_t tick = 0;     ///< of the timer, from the start of the trajectory
    double due = 0.0;          ///< exact time, s
    int axis = 0;              ///< index
    int direction = 1;         ///< +1 or -1
    std::int64_t position = 0; ///< of the motor after the pulse, steps from the machine's zero
    int block = 0;             ///< that it belongs to
};

/// Of one axis. Times in s, frequencies in Hz.
struct StepJitter {
    std::int64_t pulses = 0;
    std::int64_t reversals = 0;
    double max_frequency = 0.0;   ///< one way, by the exact times
    double given_frequency = 0.0; ///< one way, by the ticks
    double max_jitter = 0.0;      ///< largest |tick - due|
    double rms_jitter = 0.0;
    std::int64_t late = 0;       ///< put off because they were due within min_interval of another
    std::int64_t over_limit = 0; ///< off by more than jitter_limit
    /// Of the first pulse that waits for more than the one before it, so that others wait for it in turn: the
    /// timer does not keep up. -1: it does.
    int overrun_block = -1;
    double end_error_steps = 0.0; ///< motor against plan at the end, never more than half a step
};

using StepSink = std::function<void(std::span<const StepPulse>)>;

/// Gives the pulses to `sink` in the order of their ticks, block by block, and returns the report of every
/// axis. The memory that it takes does not grow with the number of pulses. The motor starts on the step
/// nearest to the trajectory's start. Throws Error for settings that make no sense or too many pulses in one
/// block, Cancelled through `progress`.
std::vector<StepJitter> step_pulses(const Trajectory& trajectory,
                                    const StepSettings& settings,
                                    const StepSink& sink,
                                    const Progress& progress);

} // namespace millwright::motion
