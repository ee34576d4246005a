#include "ui/workspaces/start_prompt.h"

#include "core/jobs/tool_check.h"
#include "ui/workspaces/machine_connection.h"

#include <utility>

namespace millwright::actions {

StartWish start_wish(jobs::Job job, std::optional<jobs::QueuedJobId> queued, const ConnectionView& machine) {
    StartWish wish;
    wish.job = std::make_shared<const jobs::Job>(std::move(job));
    wish.queued = queued;
    wish.machine = (machine.firmware.empty() ? machine.choice.driver : machine.firmware) +
                   (machine.choice.address.empty() ? "" : " at " + machine.choice.address);
    wish.program_check.dialect = machine.can.dialect.value_or(gcode::Dialect::linuxcnc);
    wish.program_check.axes = machine.axes;
    wish.program_check.start = machine.status.position;
    wish.program_check.offsets = machine.offsets;
    wish.program_check.modes = machine.status.modes;
    wish.program_check.mist = machine.can.mist;
    wish.program_check.firmware = machine.can.firmware;
    wish.program_check.watched = jobs::watched_lines(*wish.job);
    wish.limits = machine.limits;
    wish.can = machine.can;
    wish.status = machine.status;
    return wish;
}

StartCheck check_start(const std::shared_ptr<const StartWish>& wish, const Progress& progress) {
    progress.check();
    const jobs::Job& job = *wish->job;
    StartCheck check{wish, {}, {}, {}, static_cast<int>(std::ssize(wish->program_check.watched)), {}};
    try {
        check.program_check =
            jobs::check_program(jobs::controller_text(job), job.project, wish->program_check);
        check.faults = job.program != nullptr
                           ? jobs::preflight(job)
                           : jobs::faults_of(check.program_check, wish->limits, job.project);
        check.tool = jobs::tool_before_start(job, check.program_check);
        const jobs::ToolChangePlace place{
            wish->status, wish->program_check.offsets, wish->limits, wish->can.laser};
        const auto of_tools = jobs::tool_change_faults(job, check.program_check, wish->can, place);
        check.faults.insert(check.faults.end(), of_tools.begin(), of_tools.end());
        if (job.program != nullptr && !check.program_check.missing_axes.empty()) {
            check.faults.insert(check.faults.begin(), check.program_check.errors.front());
        }
        check.warnings = jobs::warnings_of(check.program_check, wish->limits, job.project);
    } catch (const Error& error) {
        check.faults.push_back(error.diagnostic());
    }
    return check;
}

} // namespace millwright::actions
