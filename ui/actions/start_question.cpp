#include "ui/actions/start_question.h"

#include "ui/actions/controller.h"

#include <utility>

namespace millwright::actions {

StartWish start_wish(jobs::Job job, std::optional<jobs::QueuedJobId> queued, const ControllerView& machine) {
    StartWish wish;
    wish.job = std::make_shared<const jobs::Job>(std::move(job));
    wish.queued = queued;
    wish.machine = (machine.firmware.empty() ? std::string(to_text(machine.choice.kind)) : machine.firmware) +
                   (machine.choice.address.empty() ? "" : " at " + machine.choice.address);
    wish.survey.dialect = machine.can.dialect.value_or(gcode::Dialect::linuxcnc);
    wish.survey.axes = machine.axes;
    wish.survey.start = machine.status.position;
    wish.survey.offsets = machine.offsets;
    wish.survey.modes = machine.status.modes;
    wish.survey.mist = machine.can.mist;
    wish.survey.firmware = machine.can.firmware;
    wish.limits = machine.limits;
    return wish;
}

StartCheck check_start(const std::shared_ptr<const StartWish>& wish, const Progress& progress) {
    progress.check();
    const jobs::Job& job = *wish->job;
    StartCheck check{wish, {}, {}, {}};
    try {
        check.survey = jobs::survey(job.listing->text, job.project, wish->survey);
        check.faults = job.program != nullptr ? jobs::preflight(job)
                                              : jobs::faults_of(check.survey, wish->limits, job.project);
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
