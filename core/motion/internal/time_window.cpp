#include "core/motion/internal/time_window.h"

#include "core/motion/internal/phases.h"
#include "core/motion/internal/stretches.h"

#include <algorithm>
#include <vector>

namespace millwright::motion::internal {

TimeWindow::TimeWindow(const Mechanism& machine,
                       const PlannerSettings& settings,
                       const kinematics::AxisPositions& start,
                       double filter_time)
    : filter_time_(filter_time), road_(machine, settings, filter_time, start, false) {}

void TimeWindow::add(const program::Block& block, double path_acceleration) {
    road_.add(block, path_acceleration);
    if (block.kind == program::BlockKind::dwell && block.duration > 0.0) {
        time_ += block.duration;
    }
    if (road_.block_count() >= full_) {
        pass(false);
        full_ = std::max(least_window, 2 * road_.block_count()); // so that a block is looked at twice or so
    }
}

double TimeWindow::finish() {
    road_.finish();
    pass(true);
    return time_;
}

/// Counts the time of what is settled, or of all, and forgets it.
void TimeWindow::pass(bool all) {
    const Path& path = road_.with_limits();
    const std::vector<Stretch> stretches =
        stretches_of(path, {road_.kept_from(), way_, road_.limited_to()}, {});
    const std::size_t count =
        all ? stretches.size() : settled(path, stretches, road_.limited_to() - road_.reach());
    if (count == 0) {
        return;
    }
    const std::vector<double> speeds = reached_speeds(stretches, allowed_speeds(path, stretches), speed_);
    PhaseList list({Phase{0.0, way_, speed_, 0.0}});
    for (std::size_t n = 0; n < count; ++n) {
        list.go(stretches[n], speeds[n], speeds[n + 1]);
        moving_ = moving_ || stretches[n].end > stretches[n].begin;
        if (moving_ && !(speeds[n + 1] > 0.0)) {
            list.stand(filter_time_);
            moving_ = false;
        }
    }
    time_ += list.time();
    way_ = stretches[count - 1].end;
    speed_ = speeds[count];
    road_.forget_before(way_);
}

} // namespace millwright::motion::internal
