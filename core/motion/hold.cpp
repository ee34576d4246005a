#include "core/motion/hold.h"

#include "core/motion/internal/timeline.h"

#include <utility>

namespace millwright::motion {

// A motion never slows down by more than the path's greatest acceleration. Braking by that much all the time
// is therefore never faster than it, and passes every place at most as fast.
Trajectory brake(const Trajectory& now, double time) {
    return internal::brake_to_rest(now.shared_path(), internal::departure(now, time));
}

Trajectory go_on(const Trajectory& now, double time, const Override& rates) {
    return go_on_along(now.shared_path(), now, time, rates);
}

Trajectory
go_on_along(std::shared_ptr<const Path> path, const Trajectory& now, double time, const Override& rates) {
    return internal::go_to_the_end(std::move(path), internal::departure(now, time), rates, Progress());
}

} // namespace millwright::motion
