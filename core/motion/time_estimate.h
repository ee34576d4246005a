// How long a program takes, while it is read: the duration of the plan that plan() would make of all its
// blocks, in memory for those alone whose speeds can still change. That is as many as lie within the longest
// way of braking, and some thousands.
#pragma once

#include "core/motion/planner.h"
#include "core/program/program.h"

#include <memory>
#include <vector>

namespace millwright::motion {

/// The time over which the motion of a program is averaged so that no axis exceeds its jerk: so long that no
/// axis that moves changes its acceleration from one limit to the other faster (trajectory.h).
class FilterTime {
public:
    FilterTime(const kinematics::MachineModel& machine, kinematics::AxisPositions start);
    /// `limits`: of each axis.
    FilterTime(const std::vector<AxisLimits>& limits, kinematics::AxisPositions start);

    /// Throws Defect if the block's target is not finite.
    void add(const program::Block& block);
    [[nodiscard]] double seconds() const { return seconds_; } ///< of the blocks so far; 0: no limits of jerk
    [[nodiscard]] bool settled() const { return !(seconds_ < most_); } ///< no block can change it any more

private:
    kinematics::AxisPositions start_;
    std::vector<double> of_axis_; ///< s
    double most_ = 0.0;
    double seconds_ = 0.0;
};

class TimeEstimate {
public:
    /// From `start`; `filter` has seen all blocks, or is settled. The machine must outlive it. Throws Defect
    /// for what plan() does.
    TimeEstimate(const kinematics::MachineModel& machine,
                 const PlannerSettings& settings,
                 const kinematics::AxisPositions& start,
                 const FilterTime& filter);
    TimeEstimate(const TimeEstimate&) = delete;
    TimeEstimate& operator=(const TimeEstimate&) = delete;
    ~TimeEstimate();

    /// Blocks of the machine's axes, in their order. Throws what plan() throws for a block.
    void add(const program::Block& block);
    /// Of all blocks, s. Nothing is added after it.
    [[nodiscard]] double finish();
    /// Blocks that are in memory now.
    [[nodiscard]] int blocks_kept() const;

private:
    class Window;
    std::unique_ptr<Window> window_;
};

} // namespace millwright::motion
