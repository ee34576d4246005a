#include "core/motion/hold.h"

#include "core/base/error.h"
#include "core/motion/internal/timeline.h"

#include <algorithm>
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

Trajectory go_on_for(int blocks, const Trajectory& now, double time, const Override& rates) {
    expects(blocks > 0, "a motion continues for at least one block");
    internal::Departure from = internal::departure(now, time);
    const int next = internal::first_block_after(now.path(), from);
    const int last = std::max(std::min(now.block_count(), next + blocks) - 1,
                              internal::first_block_to_rest_in(now.path(), from));
    return internal::go_to_the_end_of(last, now.shared_path(), std::move(from), rates, Progress());
}

Trajectory
go_on_along(std::shared_ptr<const Path> path, const Trajectory& now, double time, const Override& rates) {
    const int last = path->block_count() - 1;
    return internal::go_to_the_end_of(
        last, std::move(path), internal::departure(now, time), rates, Progress());
}

} // namespace millwright::motion
