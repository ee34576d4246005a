#include "core/motion/internal/time_window.h"

#include "core/motion/internal/phases.h"
#include "core/motion/internal/speed_segments.h"

#include <algorithm>
#include <vector>

namespace millwright::motion::internal {

TimeWindow::TimeWindow(const Mechanism& machine,
                       const PlannerSettings& settings,
                       const kinematics::AxisPositions& start,
                       double filter_time)
    : filter_time_(filter_time), builder_(machine, settings, filter_time, start, false) {}

void TimeWindow::add(const program::Block& block, double path_acceleration) {
    builder_.add(block, path_acceleration);
    if (block.kind == program::BlockKind::dwell && block.duration > 0.0) {
        time_ += block.duration;
    }
    if (builder_.block_count() >= full_) {
        pass(false);
        full_ =
            std::max(least_window, 2 * builder_.block_count()); // so that a block is looked at twice or so
    }
}

double TimeWindow::finish() {
    builder_.finish();
    pass(true);
    return time_;
}

/// Counts the time of what is settled, or of all, and forgets it.
void TimeWindow::pass(bool all) {
    const Path& path = builder_.with_limits();
    const std::vector<SpeedSegment> speed_segments =
        speed_segments_of(path, {builder_.kept_from(), way_, builder_.limited_to()}, {});
    const std::size_t count =
        all ? speed_segments.size() : settled(path, speed_segments, builder_.limited_to() - builder_.reach());
    if (count == 0) {
        return;
    }
    const std::vector<double> speeds =
        reached_speeds(speed_segments, allowed_speeds(path, speed_segments), speed_);
    PhaseList list({Phase{0.0, way_, speed_, 0.0}});
    for (std::size_t n = 0; n < count; ++n) {
        list.go(speed_segments[n], speeds[n], speeds[n + 1]);
        moving_ = moving_ || speed_segments[n].end > speed_segments[n].begin;
        if (moving_ && !(speeds[n + 1] > 0.0)) {
            list.stand(filter_time_);
            moving_ = false;
        }
    }
    time_ += list.time();
    way_ = speed_segments[count - 1].end;
    speed_ = speeds[count];
    builder_.forget_before(way_);
}

} // namespace millwright::motion::internal
