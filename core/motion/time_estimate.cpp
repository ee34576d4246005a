#include "core/motion/time_estimate.h"

#include "core/motion/internal/leg.h"
#include "core/motion/internal/mechanism.h"
#include "core/motion/internal/phases.h"
#include "core/motion/internal/road_builder.h"
#include "core/motion/internal/stretches.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::motion {

using kinematics::AxisPositions;
using kinematics::MachineModel;

FilterTime::FilterTime(const MachineModel& machine, AxisPositions start)
    : FilterTime(internal::limits_of(internal::MachineMechanism(machine)), std::move(start)) {}

FilterTime::FilterTime(const std::vector<AxisLimits>& limits, AxisPositions start)
    : start_(std::move(start)) {
    for (const AxisLimits& axis : limits) {
        of_axis_.push_back(2.0 * axis.acceleration / axis.jerk);
        most_ = std::max(most_, of_axis_.back());
    }
}

void FilterTime::add(const gcode::Block& block) {
    const AxisPositions after = internal::position_after(block, start_);
    for (std::size_t n = 0; n < of_axis_.size(); ++n) {
        const auto axis = static_cast<Eigen::Index>(n);
        if (std::abs(after[axis] - start_[axis]) > 0.0) {
            seconds_ = std::max(seconds_, of_axis_[n]);
        }
    }
}

/// Lays the way of the axes, and leaves behind what is settled.
class TimeEstimate::Window {
public:
    Window(const MachineModel& machine,
           const PlannerSettings& settings,
           const AxisPositions& start,
           double filter_time)
        : mechanism_(machine), settings_(settings), filter_time_(filter_time),
          road_(mechanism_, settings_, filter_time, start, false) {}

    void add(const gcode::Block& block) {
        road_.add(block);
        if (block.kind == gcode::BlockKind::dwell && block.duration > 0.0) {
            time_ += block.duration;
        }
        if (road_.block_count() >= full_) {
            pass(false);
            full_ =
                std::max(least_window, 2 * road_.block_count()); // so that a block is looked at twice or so
        }
    }

    [[nodiscard]] double finish() {
        road_.finish();
        pass(true);
        return time_;
    }

    [[nodiscard]] int block_count() const { return road_.block_count(); }

private:
    static constexpr int least_window = 4096; ///< blocks

    internal::MachineMechanism mechanism_;
    PlannerSettings settings_;
    double filter_time_;
    internal::RoadBuilder road_;
    int full_ = least_window;
    double way_ = 0.0, speed_ = 0.0; ///< up to which the time is counted
    bool moving_ = false;            ///< since the last rest
    double time_ = 0.0;

    /// Counts the time of what is settled, or of all, and forgets it.
    void pass(bool all) {
        const Path& path = road_.with_limits();
        const double kept_from = road_.kept_from();
        const std::vector<internal::Stretch> stretches =
            internal::stretches_of(path, {kept_from, way_, road_.limited_to()}, {});
        const std::size_t count =
            all ? stretches.size() : internal::settled(path, stretches, road_.limited_to() - road_.reach());
        if (count == 0) {
            return;
        }
        const std::vector<double> speeds =
            internal::reached_speeds(stretches, internal::allowed_speeds(path, stretches), speed_);
        internal::PhaseList list({Phase{0.0, way_, speed_, 0.0}});
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
};

TimeEstimate::TimeEstimate(const MachineModel& machine,
                           const PlannerSettings& settings,
                           const AxisPositions& start,
                           const FilterTime& filter) {
    internal::check_settings(settings, internal::MachineMechanism(machine), start);
    window_ = std::make_unique<Window>(machine, settings, start, filter.seconds());
}

TimeEstimate::~TimeEstimate() = default;

void TimeEstimate::add(const gcode::Block& block) {
    window_->add(block);
}

double TimeEstimate::finish() {
    return window_->finish();
}

int TimeEstimate::blocks_kept() const {
    return window_->block_count();
}

} // namespace millwright::motion
