// Leaving a motion while it runs, always on its path and within the limits of its axes: feed hold, stop,
// resume, and other feeds and rapids.
#pragma once

#include "core/motion/override.h"
#include "core/motion/trajectory.h"

#include <memory>

namespace millwright::motion {

/// From where `now` is at `time` to rest, as soon as the axes allow. Its time starts at 0.
[[nodiscard]] Trajectory brake(const Trajectory& now, double time);

/// From where `now` is at `time`, moving or at rest, to the end of its path, with feeds and rapids at
/// `rates`. Faster than these, it brakes down to them. Its time starts at 0. Throws Defect for an override
/// out of range. Takes about 1 microsecond a block.
[[nodiscard]] Trajectory go_on(const Trajectory& now, double time, const Override& rates);

/// The same, but no more than `blocks` of them if the axes can, the last of which ends at rest. Who goes on
/// again half-way does not notice that end, and never plans for long.
[[nodiscard]] Trajectory go_on_for(int blocks, const Trajectory& now, double time, const Override& rates);

/// The same along another path to its end, which has the same blocks as the present one up to the present.
[[nodiscard]] Trajectory
go_on_along(std::shared_ptr<const Path> path, const Trajectory& now, double time, const Override& rates);

} // namespace millwright::motion
