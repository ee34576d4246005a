#include "core/plan/planned_time.h"

#include "core/motion/planner.h"
#include "core/plan/plan.h"
#include "core/program/post.h"

namespace millwright::plan {

std::optional<double> planned_time(const toolpath::Toolpath& path,
                                   const toolpath::AxisPath& axes,
                                   const kinematics::MachineModel& machine,
                                   const project::ProgramInput& input,
                                   const Progress& progress) {
    try {
        const program::PostResult posted =
            program::post(machine, path, axes, program_settings(input), {}, progress);
        progress.check();
        return motion::plan(posted.program, machine, motion::PlannerSettings{}, progress).duration();
    } catch (const Error&) { // such a program is beyond the machine's limits
        return std::nullopt;
    }
}

} // namespace millwright::plan
