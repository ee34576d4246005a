#include "core/motion/time_estimate.h"

#include "core/motion/internal/axis_path.h"
#include "core/motion/internal/mechanism.h"
#include "core/motion/internal/planned_move.h"
#include "core/motion/internal/rounding_choice.h"

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

void FilterTime::add(const program::Block& block) {
    const AxisPositions after = internal::position_after(block, start_);
    for (std::size_t n = 0; n < of_axis_.size(); ++n) {
        const auto axis = static_cast<Eigen::Index>(n);
        if (std::abs(after[axis] - start_[axis]) > 0.0) {
            seconds_ = std::max(seconds_, of_axis_[n]);
        }
    }
}

class TimeEstimate::Window {
public:
    Window(const MachineModel& machine,
           const PlannerSettings& settings,
           const AxisPositions& start,
           double filter_time)
        : mechanism_(machine), settings_(settings),
          choice_(mechanism_, settings_, start, filter_time, false) {}

    internal::RoundingChoice& choice() { return choice_; }

private:
    internal::MachineMechanism mechanism_;
    PlannerSettings settings_;
    internal::RoundingChoice choice_;
};

TimeEstimate::TimeEstimate(const MachineModel& machine,
                           const PlannerSettings& settings,
                           const AxisPositions& start,
                           const FilterTime& filter) {
    internal::check_settings(settings, internal::MachineMechanism(machine), start);
    window_ = std::make_unique<Window>(machine, settings, start, filter.seconds());
}

TimeEstimate::~TimeEstimate() = default;

void TimeEstimate::add(const program::Block& block) {
    window_->choice().add(block);
}

double TimeEstimate::finish() {
    return window_->choice().finish();
}

int TimeEstimate::blocks_kept() const {
    return window_->choice().block_count();
}

} // namespace millwright::motion
