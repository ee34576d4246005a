// One axis position for every path point: the branch of the inverse kinematics chosen by continuity.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/kinematics/rotary_tilt.h"
#include "core/toolpath/toolpath.h"

#include <string>
#include <vector>

namespace millwright::toolpath {

// What is said of a path point that cannot be run.

/// Throws Error with the point's number, node and tip, and `why`.
[[noreturn]] void refuse_point(std::size_t n, const PathPoint& point, const std::string& why);

/// Axis positions, one per path point. The tool reaches every pose exactly (round_trip_mm).
struct AxisPath {
    std::vector<kinematics::AxisPositions> positions;
    double rotary_travel = 0.0; ///< sum over moves and rotary axes, rad
};

/// Each point takes the branch with the least rotary travel from the point before; the first takes the branch
/// nearest to the axes' zero. On a pole the free angle is that of the point before, so that no rotation in
/// place is hidden; at the start of a track, which is reached off the part, it is that of the next point off
/// the pole. Throws Error with the point's node and the reason where a pose cannot be reached.
[[nodiscard]] AxisPath sequence(const kinematics::MachineModel& machine, const Toolpath& toolpath);

/// The same with rotary angles by the thesis's faulty formulas, point by point, for regression only: the tip
/// is exact at every point, the tool axis is not. Throws Error if the machine does not offer these formulas.
[[nodiscard]] AxisPath sequence_by_formulas(const kinematics::MachineModel& machine,
                                            const Toolpath& toolpath,
                                            kinematics::AngleMode mode);

} // namespace millwright::toolpath
