// Phases of constant acceleration (timing.h), put one after another.
#pragma once

#include "core/motion/internal/speed_segments.h"
#include "core/motion/timing.h"

namespace millwright::motion::internal {

class PhaseList {
public:
    /// What was before time 0, the last phase at time 0 being the state to go on from.
    explicit PhaseList(std::vector<Phase> history);

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] double way() const { return way_; }

    /// From the speed at the begin of a segment to that at its end: up to `speed_segment.speed` and down
    /// again. A begin that is faster brakes down to it.
    void go(const SpeedSegment& speed_segment, double start_speed, double end_speed);
    /// Brakes at the segment's acceleration from `start_speed` up to `end` of the way, to `end_speed`.
    void brake(double start_speed, double end_speed, double acceleration, double end);
    void stand(double seconds);

    /// Ends at rest.
    [[nodiscard]] std::vector<Phase> take();

private:
    void add(double way, double speed, double acceleration, double duration);

    std::vector<Phase> phases_;
    double time_ = 0.0;
    double way_ = 0.0;
};

} // namespace millwright::motion::internal
