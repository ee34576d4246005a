#include "core/machine/driver.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/actions/job_source.h"
#include "ui/actions/workshop.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using machine::DriverState;
using widgets::Permission;

Permission machine_ready(const Workbench& now) {
    switch (now.controller.link) {
    case LinkState::none:
        return {};
    case LinkState::connecting:
    case LinkState::closing:
        return Permission::refused("The machine is being connected or disconnected.");
    case LinkState::connected:
        break;
    }
    const DriverState state = now.controller.status.state;
    if (state == DriverState::alarm) {
        return Permission::refused("There is an alarm: home or unlock first.");
    }
    return state == DriverState::idle || state == DriverState::stopped
               ? Permission{}
               : Permission::refused("The machine is moving.");
}

/// Where it is to begin at a line, what comes before is known and was shown.
Permission approach_ready(const Workbench& now) {
    if (!now.session.begin.on) {
        return {};
    }
    if (!now.approach || !(now.approach->wish.begin == now.session.begin)) {
        return Permission::refused("The approach to the line is being worked out.");
    }
    return now.approach->refusal ? Permission::refused(to_text(*now.approach->refusal)) : Permission{};
}

Permission can_run(const Workbench& now) {
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    for (const Permission& permission : {program_ready(now), approach_ready(now)}) {
        if (!permission.allowed) {
            return permission;
        }
    }
    return machine_ready(now);
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
    const Workbench& now = hands.now;
    machine::Job job = hands.session.begin.on ? *now.approach->job : make_job(job_source(now));
    job.started_at = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
    hands.session.playback.playing = false;
    hands.session.file.step.reset();
    hands.session.begin = {};
    hands.session.workspace = Workspace::machine;
    if (auto driver = hands.workshop.controller().driver()) {
        driver->check(*job.listing, job.project);
        hands.jobs.start(std::move(job), std::move(driver));
    } else {
        hands.jobs.start(std::move(job), hands.session.machine_speed);
    }
}

Permission can_stop_at_once(const Workbench& now) {
    return now.job.running || now.controller.connected() ? Permission{}
                                                         : Permission::refused("No machine is connected.");
}

void stop_at_once(Hands& hands) {
    hands.workshop.controller().emergency_stop();
    hands.jobs.emergency_stop();
}

} // namespace

void add_machine_actions(Actions& actions) {
    add(actions,
        {"machine.run",
         "Machine",
         "Run the program",
         "Checks the program and sends it to the connected machine, else to a virtual one.",
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
        can_stop_at_once,
        stop_at_once);
}

} // namespace millwright::actions
