#include "core/motion/planner.h"

#include "core/motion/internal/road.h"
#include "core/motion/internal/timeline.h"

#include <memory>
#include <utility>

namespace millwright::motion {

Trajectory plan(const gcode::Program& program,
                const kinematics::MachineModel& machine,
                const PlannerSettings& settings,
                const Progress& progress,
                const std::optional<kinematics::AxisPositions>& start) {
    constexpr double laid_out = 0.5; // of the work
    auto path = std::make_shared<const Path>(internal::lay_out(
        program, machine, settings, start.value_or(program.start), progress.part(0.0, laid_out)));
    progress.report(laid_out);
    const int last = path->block_count() - 1;
    Trajectory trajectory = internal::go_to_the_end_of(
        last, std::move(path), internal::departure(), {}, progress.part(laid_out, 1.0));
    progress.report(1.0);
    return trajectory;
}

} // namespace millwright::motion
