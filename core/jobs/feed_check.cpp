#include "core/jobs/feed_check.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::jobs {

std::optional<Diagnostic> feeds_not_reached(const Job& job) {
    expects(job.program != nullptr && job.machine != nullptr, "a job with a program has a machine");
    constexpr double rounding = 1.0 + 1e-6;
    std::optional<Diagnostic> first;
    int count = 0;
    const kinematics::AxisPositions* from = &job.program->start;
    for (int n = 0; n < job.program->block_count(); ++n) {
        const program::Block& block = job.program->blocks[static_cast<std::size_t>(n)];
        for (int axis = 0; axis < job.machine->axis_count() && block.kind == program::BlockKind::feed;
             ++axis) {
            const kinematics::MachineAxis& limits = job.machine->axis(axis);
            const double way = std::abs(block.target[axis] - (*from)[axis]);
            if (!(way > limits.max_velocity * block.duration * rounding)) {
                continue;
            }
            if (++count == 1) {
                first = {{job.project, job.listing->line_of_block[static_cast<std::size_t>(n)], 0, -1},
                         fmt::format("{:.0f} mm/min exceeds the maximum speed of axis {}",
                                     60.0 * block.feed,
                                     limits.letter),
                         "the machine will be slower"};
            }
            break;
        }
        from = &block.target;
    }
    if (count > 1) {
        first->message += fmt::format(", and so do {} later feeds", count - 1);
    }
    return first;
}

} // namespace millwright::jobs
