// What a simulated program cuts as curves over the time of its motion.
#pragma once

#include "core/motion/trajectory.h"
#include "core/simulation/engagement.h"

#include <span>
#include <vector>

namespace millwright::panels {

/// Columns at equal steps of time; in each the largest value of the feeds that fall into it. Not finite: no
/// feed, which leaves a gap.
struct EngagementSeries {
    std::vector<double> time;         ///< s
    std::vector<double> rate;         ///< mm^3/min, of feeds that cut
    std::vector<double> air;          ///< 0 where feeds alone that cut nothing fall into the column
    std::vector<double> depth, width; ///< mm, of feeds that cut
};

/// `feeds` in the order of the blocks of `trajectory`. Throws Defect unless `columns` is 2 or more.
[[nodiscard]] EngagementSeries engagement_series(std::span<const simulation::FeedEngagement> feeds,
                                                 const motion::Trajectory& trajectory,
                                                 int columns);

} // namespace millwright::panels
