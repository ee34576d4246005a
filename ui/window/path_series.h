// Curves over the length of the path, for plots and the timeline.
#pragma once

#include "ui/workspaces/frame_state.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::panels {

/// The error of each move of `evaluation` over the path length, mm: a step in the middle of each move.
struct ErrorOverPath {
    std::vector<double> at; ///< path length at the middle of each move, mm
    std::vector<double>
        error; ///< closest, mm; NaN from track to track, as these moves are no part of the error
};
[[nodiscard]] ErrorOverPath error_over_path(const plan::Evaluation& evaluation);

/// A path whose error is plotted, under the name that the key has: which it is, whether the program follows
/// it, and whether its figures are so far.
struct PlottedPath {
    std::shared_ptr<const plan::Evaluation> path;
    std::string name;
};
/// The path on screen comes last; before it what stands beside it, else that over the uniform grid, where it
/// is another one. Empty where no path of the project is on screen: none is there yet, or a G-code file, a
/// plot or a surface that is being imported is.
[[nodiscard]] std::vector<PlottedPath> plotted_paths(const actions::FrameState& now);

/// Length of the path of `evaluation` up to `fraction` of `move`, mm; 0 before the path.
[[nodiscard]] double length_before(const plan::Evaluation& evaluation, int move, double fraction);

/// Error of the program's moves and the feed on the part at `count` equal steps of the tip's way.
struct TrajectorySeries {
    std::vector<double> error;           ///< mm; 0 off the part
    std::vector<double> feed_mm_per_min; ///< actual speed of the tip between two steps
};
[[nodiscard]] TrajectorySeries series_over_way(const motion::Trajectory& trajectory,
                                               const program::Program& program,
                                               const plan::Evaluation& evaluation,
                                               int count);

} // namespace millwright::panels
