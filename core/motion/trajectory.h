// The axes as functions of time. Lengths mm, angles rad, times s.
#pragma once

#include "core/motion/path.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace millwright::motion {

// The way as a function of time. First unfiltered: phases of constant acceleration, which keep every limit
// but that of jerk. Then filtered: the mean of the unfiltered way over the last `filter_time` seconds, whose
// acceleration changes by at most 2 * acceleration / filter_time per second. The path stays the same, since
// only the timing along it is filtered (docs/reference/motion.md#jerk). Scaled units (path.h).

/// From `time` to the next phase.
struct Phase {
    double time = 0.0;
    double way = 0.0, speed = 0.0; ///< at `time`
    double acceleration = 0.0;
};

/// The way and its derivatives by time.
struct Motion {
    double way = 0.0, speed = 0.0, acceleration = 0.0, jerk = 0.0;
};

class Timing {
public:
    /// `phases` in the order of their times; before the first the way is at rest, the last one is the rest at
    /// its end. Throws Defect if there is none or a number is not finite.
    Timing(std::vector<Phase> phases, double filter_time);

    [[nodiscard]] double filter_time() const { return filter_time_; }
    [[nodiscard]] double end() const { return phases_.back().time; }
    [[nodiscard]] const std::vector<Phase>& phases() const { return phases_; }

    /// Filtered; without a filter the jerk is 0, though the acceleration jumps between phases.
    [[nodiscard]] Motion at(double time) const;
    [[nodiscard]] Motion unfiltered_at(double time) const;
    /// When the filtered way is `way`, between `from` and `to`, where it must be. Exact but for rounding.
    [[nodiscard]] double time_of(double way, double from, double to) const;
    /// When the unfiltered way reaches `way` for the first time.
    [[nodiscard]] double unfiltered_time_of(double way) const;
    /// The phases that the filter sees at `time`, with `time` as the new zero, and its unfiltered state.
    [[nodiscard]] std::vector<Phase> history(double time) const;
    /// Since when the unfiltered way has been at rest at `time`; `time` itself if it moves.
    [[nodiscard]] double at_rest_since(double time) const;

private:
    /// The unevaluated sum of two doubles: the integral of the way is long, what is needed of it short.
    struct Sum {
        double high = 0.0, low = 0.0;
    };
    struct State {
        double way = 0.0, speed = 0.0, acceleration = 0.0;
        Sum integral; ///< of the way, from the first phase
    };

    [[nodiscard]] std::size_t phase_at(double time) const;
    [[nodiscard]] State state_at(double time) const;

    void fill_buckets();

    std::vector<Phase> phases_;
    std::vector<std::uint32_t>
        buckets_; ///< of equal time: the phase in which each begins; and the last phase
    double buckets_per_second_ = 0.0;
    std::vector<Sum> integrals_; ///< of the way up to each phase; empty without a filter
    double filter_time_ = 0.0;
};

/// Everything about one instant.
struct Sample {
    kinematics::AxisPositions position, velocity, acceleration;
    kinematics::AxisPositions jerk; ///< 0 without limits of jerk, though the acceleration jumps then
    int block = 0;                  ///< being executed
    double fraction = 0.0;          ///< of its way, or of its time if it stands still, 0 to 1
};

/// Which blocks a trajectory executes, and when.
struct Schedule {
    int first_block = 0;
    double standing_done = 0.0; ///< of a dwell of the first block, before the trajectory, s
    std::vector<double> ends;   ///< when each block ends that the trajectory executes, none before another
};

/// Can be sampled anywhere in O(log blocks). Safe to read from any thread.
class Trajectory {
public:
    /// Throws Defect if the schedule is none of the path.
    Trajectory(std::shared_ptr<const Path> path, Timing timing, Schedule schedule);

    [[nodiscard]] double duration() const { return times_.back(); }
    [[nodiscard]] int axis_count() const;
    /// Blocks of the whole program, of which this trajectory executes first_block() to last_block().
    [[nodiscard]] int block_count() const { return path_->block_count(); }
    [[nodiscard]] int first_block() const { return first_block_; }
    [[nodiscard]] int last_block() const;

    /// At `time`, or at the nearer end for a time outside of [0, duration()]. Where blocks meet, the later
    /// one with any duration counts. Throws Defect if `time` is not a number.
    [[nodiscard]] Sample at(double time) const;
    [[nodiscard]] int block_at(double time) const;
    /// What keeps the motion from being faster at `time`.
    [[nodiscard]] Cause limit_at(double time) const;

    /// When a block begins and ends; both the same for one that takes no time.
    [[nodiscard]] double start_of(int block) const;
    [[nodiscard]] double end_of(int block) const;
    /// When `fraction` of the block's way is done.
    [[nodiscard]] double time_at(int block, double fraction) const;
    /// limit_at() the middle of the block's time.
    [[nodiscard]] Cause limit_of(int block) const;

    /// The tip's way on the part so far, mm (chords of the blocks), and when it has come that far.
    [[nodiscard]] double part_length_at(double time) const;
    [[nodiscard]] double time_at_part_length(double length) const;
    [[nodiscard]] double part_length() const { return path_->part_length.back(); }

    [[nodiscard]] const Path& path() const { return *path_; }
    [[nodiscard]] const std::shared_ptr<const Path>& shared_path() const { return path_; }
    [[nodiscard]] const Timing& timing() const { return timing_; }

private:
    /// Where a time is in its block.
    struct Place {
        int block = 0;
        double offset = 0.0; ///< into its way
        double fraction = 1.0;
        Motion motion;
    };
    [[nodiscard]] Place place_at(double time) const;
    [[nodiscard]] std::size_t index_of(int block) const;
    [[nodiscard]] const Segment& segment(int block) const {
        return path_->segments[static_cast<std::size_t>(block)];
    }

    std::shared_ptr<const Path> path_;
    Timing timing_;
    int first_block_ = 0;
    double standing_done_ = 0.0;
    std::vector<double> times_; ///< when each block starts, and the end of the last
};

} // namespace millwright::motion
