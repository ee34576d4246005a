// The way as a function of time. First unfiltered: phases of constant acceleration, which keep every limit
// but that of jerk. Then filtered: the mean of the unfiltered way over the last `filter_time` seconds, whose
// acceleration changes by at most 2 * acceleration / filter_time per second. The path stays the same, since
// only the timing along it is filtered (docs/reference/motion.md#jerk). Scaled units (path.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace millwright::motion {

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

} // namespace millwright::motion
