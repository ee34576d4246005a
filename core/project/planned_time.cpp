#include "core/project/planned_time.h"

#include "core/gcode/post.h"
#include "core/motion/planner.h"
#include "core/project/plan.h"

namespace millwright::project {

std::optional<double> planned_time(const toolpath::Toolpath& path,
                                   const toolpath::AxisPath& axes,
                                   const kinematics::MachineModel& machine,
                                   const ProgramInput& input,
                                   const Progress& progress) {
    try {
        const gcode::PostResult posted =
            gcode::post(machine, path, axes, program_settings(input), {}, progress);
        progress.check();
        return motion::plan(posted.program, machine, motion::PlannerSettings{}, progress).duration();
    } catch (const Error&) { // such a program is beyond the machine's limits
        return std::nullopt;
    }
}

} // namespace millwright::project
