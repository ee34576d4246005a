// One axis position for every path point: the branch of the inverse kinematics chosen by continuity.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/toolpath/toolpath.h"

#include <vector>

namespace millwright::toolpath {

/// Axis positions, one a path point. The tool reaches every pose exactly (round_trip_mm).
struct AxisPath {
    std::vector<kinematics::AxisPositions> positions;
    double rotary_travel = 0.0; ///< sum over moves and rotary axes, rad
};

/// Each point takes the branch with the least rotary travel from the point before; the first takes the branch
/// nearest to the axes' zero. On a pole the free angle is that of the point before (of the first point off the
/// pole at the start), so that no rotation in place is hidden.
/// Throws Error with the point's node and the reason where a pose cannot be reached.
[[nodiscard]] AxisPath sequence(const kinematics::MachineModel& machine, const Toolpath& toolpath);

} // namespace millwright::toolpath
