#include "ui/actions/start_question.h"

#include "core/jobs/tool_check.h"
#include "ui/actions/controller.h"

#include <utility>

namespace millwright::actions {

StartWish start_wish(jobs::Job job, std::optional<jobs::QueuedJobId> queued, const ControllerView& machine) {
    StartWish wish;
    wish.job = std::make_shared<const jobs::Job>(std::move(job));
    wish.queued = queued;
    wish.machine = (machine.firmware.empty() ? machine.choice.driver : machine.firmware) +
                   (machine.choice.address.empty() ? "" : " at " + machine.choice.address);
    wish.survey.dialect = machine.can.dialect.value_or(gcode::Dialect::linuxcnc);
    wish.survey.axes = machine.axes;
    wish.survey.start = machine.status.position;
    wish.survey.offsets = machine.offsets;
    wish.survey.modes = machine.status.modes;
    wish.survey.mist = machine.can.mist;
    wish.survey.firmware = machine.can.firmware;
    wish.survey.watched = jobs::watched_lines(*wish.job);
    wish.limits = machine.limits;
    wish.can = machine.can;
    wish.status = machine.status;
    return wish;
}

StartCheck check_start(const std::shared_ptr<const StartWish>& wish, const Progress& progress) {
    progress.check();
    const jobs::Job& job = *wish->job;
    StartCheck check{wish, {}, {}, {}, static_cast<int>(std::ssize(wish->survey.watched)), {}};
    try {
        check.survey = jobs::survey(jobs::controller_text(job), job.project, wish->survey);
        check.faults = job.program != nullptr ? jobs::preflight(job)
                                              : jobs::faults_of(check.survey, wish->limits, job.project);
        check.tool = jobs::tool_before_start(job, check.survey);
        const jobs::ToolChangePlace place{wish->status, wish->survey.offsets, wish->limits, wish->can.laser};
        const auto of_tools = jobs::tool_change_faults(job, check.survey, wish->can, place);
        check.faults.insert(check.faults.end(), of_tools.begin(), of_tools.end());
        if (job.program != nullptr && !check.survey.missing_axes.empty()) {
            check.faults.insert(check.faults.begin(), check.survey.errors.front());
        }
        check.warnings = jobs::warnings_of(check.survey, wish->limits, job.project);
    } catch (const Error& error) {
        check.faults.push_back(error.diagnostic());
    }
    return check;
}

} // namespace millwright::actions
