// The speed along a block at which the tool tip goes along the part at a given feed: |J q'| s' = feed, with
// the Jacobian J of the tip and the direction q' of the axes.
#pragma once

#include "core/motion/internal/planned_move.h"

namespace millwright::motion::internal {

struct StraightWay {
    const kinematics::AxisPositions& from;
    const kinematics::AxisPositions& to;
    double length = 0.0; ///< scaled
};

/// Speeds that never take the tip above `feed` (mm/s), in so many steps that most of the way comes close to
/// it. Where the tip hardly moves they are infinite.
[[nodiscard]] std::vector<FeedStep>
part_speeds(const Mechanism& machine, const StraightWay& way, double feed);

} // namespace millwright::motion::internal
