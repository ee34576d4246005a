// The way cut into stretches on which speed and acceleration have one limit each, and the speeds where they
// meet.
#pragma once

#include "core/motion/override.h"
#include "core/motion/path.h"

#include <cstddef>

namespace millwright::motion::internal {

struct Stretch {
    double begin = 0.0, end = 0.0;
    double axis_speed = 0.0;   ///< that the axes allow
    double speed = 0.0;        ///< that the program wants too
    double acceleration = 0.0; ///<
};

/// From `begin` to `end` of the way. Stretches of no length are limits at one point. `filtered` is where the
/// filtered way is, whose programmed speeds still count.
struct Reach {
    double filtered = 0.0, begin = 0.0, end = 0.0;
};
[[nodiscard]] std::vector<Stretch> stretches_of(const Path& path, const Reach& reach, const Override& rates);

/// The greatest speed at the begin of each stretch, and at the end of the last, from which all that follows
/// can still be braked. With a look-ahead only so many moves are known at a time, and the last of them is
/// taken to end at rest.
[[nodiscard]] std::vector<double> allowed_speeds(const Path& path, const std::vector<Stretch>& stretches);

/// How many of the stretches, from the first, have speeds at their ends that no block behind the last stretch
/// can change; none of them ends beyond `until`.
[[nodiscard]] std::size_t settled(const Path& path, const std::vector<Stretch>& stretches, double until);

/// The greatest speeds there for a motion that begins with `speed`, which may be above what the program wants
/// (then it brakes) but not above what the axes can do.
[[nodiscard]] std::vector<double>
reached_speeds(const std::vector<Stretch>& stretches, const std::vector<double>& allowed, double speed);

} // namespace millwright::motion::internal
