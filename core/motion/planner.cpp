#include "core/motion/planner.h"

#include "core/base/error.h"
#include "core/motion/internal/axis_path.h"
#include "core/motion/internal/mechanism.h"
#include "core/motion/internal/timeline.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace millwright::motion {

namespace {

Trajectory plan_for(const internal::Mechanism& mechanism,
                    const program::Program& program,
                    const PlannerSettings& settings,
                    const Progress& progress,
                    const kinematics::AxisPositions& start,
                    std::span<const double> accelerations = {}) {
    constexpr double laid_out = 0.5; // of the work
    auto path = std::make_shared<const Path>(
        internal::lay_out(program, mechanism, settings, start, accelerations, progress.part(0.0, laid_out)));
    progress.report(laid_out);
    const int last = path->block_count() - 1;
    Trajectory trajectory = internal::go_to_the_end_of(
        last, std::move(path), internal::departure(), {}, progress.part(laid_out, 1.0));
    progress.report(1.0);
    return trajectory;
}

} // namespace

Trajectory plan(const program::Program& program,
                const kinematics::MachineModel& machine,
                const PlannerSettings& settings,
                const Progress& progress,
                const std::optional<kinematics::AxisPositions>& start) {
    const internal::MachineMechanism mechanism(machine);
    return plan_for(mechanism, program, settings, progress, start.value_or(program.start));
}

Trajectory plan_within(const program::Program& program,
                       std::span<const double> accelerations,
                       const kinematics::MachineModel& machine,
                       const PlannerSettings& settings,
                       const Progress& progress,
                       const std::optional<kinematics::AxisPositions>& start) {
    expects(accelerations.size() == program.blocks.size(), "there is an acceleration for each block");
    expects(std::ranges::all_of(accelerations, [](double value) { return value > 0.0; }),
            "what a block may be accelerated by is positive");
    const internal::MachineMechanism mechanism(machine);
    return plan_for(mechanism, program, settings, progress, start.value_or(program.start), accelerations);
}

Trajectory plan(const program::Program& program,
                const arm::ArmModel& arm,
                const PlannerSettings& settings,
                const Progress& progress) {
    const internal::ArmMechanism mechanism(arm);
    return plan_for(mechanism, program, settings, progress, program.start);
}

} // namespace millwright::motion
