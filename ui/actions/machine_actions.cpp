#include "core/machine/driver.h"
#include "ui/actions/internal/simple_action.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using machine::DriverState;
using widgets::Permission;

Permission can_run(const Workbench& now) {
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    if (!now.program() || !now.trajectory() || !now.listing()) {
        return Permission::refused("There is no program yet.");
    }
    return now.plan->exact ? Permission{} : Permission::refused("The program is still being computed.");
}

template <DriverState state> Permission driver_is(const Workbench& now) {
    const bool is = now.job.running && now.job.report && now.job.report->driver.state == state;
    return is ? Permission{}
              : Permission::refused(state == DriverState::running ? "No job is moving."
                                                                  : "No job is being held.");
}

Permission job_runs(const Workbench& now) {
    return now.job.running ? Permission{} : Permission::refused("No job is running.");
}

void run_job(Hands& hands) {
    const project::PublishedPlan& plan = *hands.now.plan;
    machine::Job job;
    job.name = "job";
    job.project = hands.document.file.empty() ? hands.history.current().name : hands.document.file.string();
    job.machine = std::make_shared<const kinematics::MachineModel>(plan.plan.workpiece->machine);
    job.program = plan.plan.program;
    job.listing = plan.plan.listing;
    hands.session.playback.playing = false;
    hands.session.workspace = Workspace::machine;
    hands.jobs.start(std::move(job), hands.session.machine_speed);
}

} // namespace

void add_machine_actions(Actions& actions) {
    add(actions,
        {"machine.run",
         "Machine",
         "Run on the virtual machine",
         "Checks the program and sends it to the virtual machine.",
         "F9",
         icons::play},
        can_run,
        run_job);
    add(actions,
        {"machine.hold",
         "Machine",
         "Hold",
         "Brakes along the path; the job can be resumed.",
         "F10",
         icons::hold},
        driver_is<DriverState::running>,
        [](Hands& hands) { hands.jobs.hold(); });
    add(actions,
        {"machine.resume", "Machine", "Resume", "Goes on where it was held.", "F11", icons::play},
        driver_is<DriverState::holding>,
        [](Hands& hands) { hands.jobs.resume(); });
    add(actions,
        {"machine.stop", "Machine", "Stop", "Brakes along the path and ends the job.", "F12", icons::stop},
        job_runs,
        [](Hands& hands) { hands.jobs.stop(); });
    add(actions,
        {"machine.emergency_stop", "Machine", "Emergency stop", "Stops at once.", "F8", icons::danger},
        job_runs,
        [](Hands& hands) { hands.jobs.emergency_stop(); });
}

} // namespace millwright::actions
