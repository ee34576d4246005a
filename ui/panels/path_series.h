// Curves over the length of the path, for plots and the timeline.
#pragma once

#include "ui/actions/workbench.h"

#include <vector>

namespace millwright::panels {

/// The error of each move of `evaluation` over the path length, mm: a step in the middle of each move.
struct ErrorOverPath {
    std::vector<double> at; ///< path length at the middle of each move, mm
    std::vector<double>
        error; ///< closest, mm; NaN from track to track, as these moves are no part of the error
};
[[nodiscard]] ErrorOverPath error_over_path(const project::Evaluation& evaluation);

/// Length of the path of `evaluation` up to `fraction` of `move`, mm; 0 before the path.
[[nodiscard]] double length_before(const project::Evaluation& evaluation, int move, double fraction);

/// Error of the program's moves and the feed on the part at `count` equal steps of the tip's way.
struct TrajectorySeries {
    std::vector<double> error;           ///< mm; 0 off the part
    std::vector<double> feed_mm_per_min; ///< actual speed of the tip between two steps
};
[[nodiscard]] TrajectorySeries series_over_way(const motion::Trajectory& trajectory,
                                               const gcode::Program& program,
                                               const project::Evaluation& evaluation,
                                               int count);

} // namespace millwright::panels
