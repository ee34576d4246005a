// The duration of a way that is laid block by block: what is settled is counted and forgotten.
#pragma once

#include "core/motion/internal/axis_path_builder.h"

#include <limits>

namespace millwright::motion::internal {

class TimeWindow {
public:
    /// From rest at `start`. Machine and settings must outlive it.
    TimeWindow(const Mechanism& machine,
               const PlannerSettings& settings,
               const kinematics::AxisPositions& start,
               double filter_time);

    /// From the next corner on.
    void set_rounding_bounds(const RoundingBounds& bounds) { builder_.set_rounding_bounds(bounds); }
    /// As AxisPathBuilder::add().
    void add(const program::Block& block, double path_acceleration = std::numeric_limits<double>::infinity());
    /// Of all blocks, s, the last one ending at rest. Nothing is added after it.
    [[nodiscard]] double finish();
    /// Blocks that are in memory now.
    [[nodiscard]] int block_count() const { return builder_.block_count(); }

private:
    static constexpr int least_window = 4096; ///< blocks

    double filter_time_;
    AxisPathBuilder builder_;
    int full_ = least_window;
    double way_ = 0.0, speed_ = 0.0; ///< up to which the time is counted
    bool moving_ = false;            ///< since the last rest
    double time_ = 0.0;

    void pass(bool all);
};

} // namespace millwright::motion::internal
