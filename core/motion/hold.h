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
/// out of range. Plans all that is left: about 1 microsecond a block.
[[nodiscard]] Trajectory go_on(const Trajectory& now, double time, const Override& rates);

/// The same along another path, which has the same blocks as the present one up to the present, and may be
/// longer.
[[nodiscard]] Trajectory
go_on_along(std::shared_ptr<const Path> path, const Trajectory& now, double time, const Override& rates);

} // namespace millwright::motion
