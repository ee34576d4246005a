// Leaving a planned motion and coming back to it, always on its path and within the limits of its axes: feed
// hold, stop and resume.
#pragma once

#include "core/motion/trajectory.h"

namespace millwright::motion {

/// From `from` to rest as soon as the axes allow, along the path of `planned`. Its time starts at 0. `from`
/// must not be faster than `planned` is there (it never is when it was reached by these functions).
[[nodiscard]] Trajectory brake(const Trajectory& planned, const PathState& from);

/// From `from`, moving or at rest, back to the speeds of `planned` and with them to its end. Time starts at
/// 0.
[[nodiscard]] Trajectory rejoin(const Trajectory& planned, const PathState& from);

/// Where a trajectory leaves the machine.
[[nodiscard]] PathState end_state(const Trajectory& trajectory);

} // namespace millwright::motion
