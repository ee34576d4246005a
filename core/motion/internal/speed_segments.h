// The way cut into segments on which speed and acceleration have one limit each, and the speeds where they
// meet.
#pragma once

#include "core/motion/override.h"
#include "core/motion/path.h"
#include "core/motion/trajectory.h"

#include <cstddef>

namespace millwright::motion::internal {

struct SpeedSegment {
    double begin = 0.0, end = 0.0;
    double axis_speed = 0.0;   ///< that the axes allow
    double speed = 0.0;        ///< that the program wants too
    double acceleration = 0.0; ///<
};

/// From `begin` to `end` of the way. Segments of no length are limits at one point. `filtered` is where the
/// filtered way is, whose programmed speeds still count.
struct WayRange {
    double filtered = 0.0, begin = 0.0, end = 0.0;
};
[[nodiscard]] std::vector<SpeedSegment>
speed_segments_of(const Path& path, const WayRange& range, const Override& rates);

/// The greatest speed at the begin of each segment, and at the end of the last, from which all that follows
/// can still be braked. With a look-ahead only so many moves are known at a time, and the last of them is
/// taken to end at rest.
[[nodiscard]] std::vector<double> allowed_speeds(const Path& path,
                                                 const std::vector<SpeedSegment>& speed_segments);

/// How many of the segments, from the first, have speeds at their ends that no block behind the last segment
/// can change; none of them ends beyond `until`.
[[nodiscard]] std::size_t
settled(const Path& path, const std::vector<SpeedSegment>& speed_segments, double until);

/// The greatest speeds there for a motion that begins with `speed`, which may be above what the program wants
/// (then it brakes) but not above what the axes can do.
[[nodiscard]] std::vector<double> reached_speeds(const std::vector<SpeedSegment>& speed_segments,
                                                 const std::vector<double>& allowed,
                                                 double speed);

// Phases of constant acceleration (trajectory.h), put one after another.

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
