#include "core/base/error.h"
#include "core/drivers/driver.h"
#include "core/jobs/box_trace.h"
#include "core/jobs/job_queue.h"
#include "core/jobs/tool_check.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/arm_workspace.h"
#include "ui/workspaces/at_rest.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/run_check.h"
#include "ui/workspaces/start_prompt.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <utility>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using drivers::DriverState;
using widgets::Permission;

Permission machine_ready(const FrameState& now) {
    switch (now.connection.link) {
    case LinkState::none:
        return {};
    case LinkState::connecting:
    case LinkState::closing:
        return Permission::refused("The machine is being connected or disconnected.");
    case LinkState::connected:
        break;
    }
    if (now.arm_connected()) {
        return Permission::refused("A PMAC runs motion programs in its own language, not G-code.");
    }
    return at_rest(now.connection);
}

/// A line in the middle is approached from what the controller takes for its position; a machine whose
/// position is entered by hand makes every move from that position.
Permission position_ready(const FrameState& now, int from_line) {
    const std::string& doubt = now.connection.status.position_doubt;
    if (now.connection.connected() && !now.connection.can.reports.position) {
        const bool assumed = from_line > 1 && !now.connection.status.position_known;
        return assumed || !doubt.empty()
                   ? Permission::refused(
                         "The machine does not report its position: read it at the machine and enter it.")
                   : Permission{};
    }
    const bool wrong =
        now.connection.connected() &&
        (from_line > 1 ? !doubt.empty()
                       : drivers::needs_confirmation(now.connection.status, now.connection.offsets));
    return wrong ? Permission::refused(drivers::doubt_sentence(doubt) +
                                       " Or confirm that the reported position is correct.")
                 : Permission{};
}

/// Those inside this program are run without a question.
bool moves_a_machine(const FrameState& now) {
    return now.connection.connected() && now.connection.row().kind != machine::MachineKind::simulated;
}

Permission nothing_asked(const FrameState& now) {
    return now.asks() ? Permission::refused("A prompt in the window is waiting for your answer.")
                      : Permission{};
}

/// What is shown there is no program of the machine before it is sent to it.
Permission nothing_but_a_plot(const FrameState& now) {
    return now.view_state.workspace == Workspace::plot && !now.plot.file().empty()
               ? Permission::refused("Open the plot's program in the Machine workspace first.")
               : Permission{};
}

Permission can_run_job(const FrameState& now) {
    if (const Permission plot = nothing_but_a_plot(now); !plot.allowed) {
        return plot;
    }
    if (const Permission free = nothing_asked(now);
        !free.allowed || now.view_state.workspace != Workspace::machine) {
        return free; // from elsewhere it only goes to the machine, where the reason stands if it cannot
    }
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    if (const Permission job = job_ready(now); !job.allowed) {
        return job;
    }
    const Permission machine = machine_ready(now);
    const Permission ready = machine.allowed ? axes_ready(now) : machine;
    const Permission checked = ready.allowed ? run_check_passed(now) : ready;
    return checked.allowed
               ? position_ready(now, now.view_state.start_at.on ? now.view_state.start_at.line : 1)
               : checked;
}

template <DriverState state> Permission driver_is(const FrameState& now) {
    const bool is = now.job.running && now.job.report && now.job.report->driver.state == state;
    return is ? Permission{}
              : Permission::refused(state == DriverState::running ? "No job is moving." : "No job is held.");
}

/// A program that runs without a job, as an arm's.
bool plays(const FrameState& now, DriverState state) {
    return now.connection.connected() && !now.job.running && now.connection.status.state == state &&
           now.connection.status.activity == drivers::Activity::program;
}

/// Points of a plot that are played to a table, while no other machine moves.
bool table_plays(const FrameState& now) {
    return !now.job.running && now.plot.table().playing();
}

bool table_plays(const FrameState& now, DriverState state) {
    const drivers::PlayState wanted =
        state == DriverState::holding ? drivers::PlayState::holding : drivers::PlayState::playing;
    return table_plays(now) && now.plot.table().view().status.state == wanted;
}

template <DriverState state> Permission moves_in(const FrameState& now) {
    return plays(now, state) || table_plays(now, state) ? Permission{} : driver_is<state>(now);
}

void hold(ActionContext& context) {
    if (context.now.job.running) {
        context.jobs.hold();
    } else if (table_plays(context.now)) {
        context.app.plot().table().hold();
    } else {
        context.app.connection().tell([](drivers::Driver& driver) { driver.hold(); });
    }
}

void resume(ActionContext& context) {
    if (context.now.job.running) {
        context.jobs.resume();
    } else if (table_plays(context.now)) {
        context.app.plot().table().resume();
    } else {
        context.app.connection().tell([](drivers::Driver& driver) { driver.resume(); });
    }
}

/// A job, or what a person has told the machine to do by hand.
Permission can_stop(const FrameState& now) {
    const DriverState state = now.connection.status.state;
    const bool by_hand =
        now.connection.connected() && (state == DriverState::running || state == DriverState::holding);
    if (now.job.running || by_hand || now.arm.works_out_path_motion() || table_plays(now)) {
        return {};
    }
    const bool stops = now.connection.connected() && state == DriverState::stopping;
    return Permission::refused(stops ? "The machine is already stopping." : "Nothing is moving.");
}

void stop(ActionContext& context) {
    context.app.arm().call_off_path_motion();
    if (table_plays(context.now)) {
        context.app.plot().table().stop();
    }
    if (context.now.job.running) {
        context.jobs.stop();
    } else if (context.now.connection.connected()) {
        context.app.connection().tell([](drivers::Driver& driver) { driver.stop(); });
    }
}

/// As they are set for the machine that is connected; of a job of the queue, too.
void make_tool_changes(const FrameState& now, jobs::Job& job) {
    if (!job.tool_change && job.program == nullptr) {
        job.tool_change = tool_change_plan(now.view_state.manual, now.connection);
    }
    read_macro(job);
}

/// On what is connected, else on a virtual machine.
void start_job(ActionContext& context, jobs::Job job, const JobRunner::Ended& ended = {}) {
    job.started_at = fmt::format("{:%Y-%m-%d %H:%M:%S}", fmt::localtime(std::time(nullptr)));
    context.view_state.playback.playing = false;
    context.view_state.file.step.reset();
    context.view_state.start_at = {};
    if (auto driver = context.app.connection().driver()) {
        make_tool_changes(context.now, job);
        driver->check(*job.listing, job.project);
        context.jobs.start(std::move(job), std::move(driver), ended);
    } else {
        context.jobs.start(std::move(job), context.view_state.machine_speed, ended);
    }
}

/// The program has to be there when the window is opened again.
Permission can_add(const FrameState& now) {
    if (now.view_state.workspace == Workspace::plot) {
        return Permission::refused(
            "Open the program in the Machine workspace first: a queued job is read from "
            "its file.");
    }
    if (!now.in_file() && (now.document.file.empty() || now.changed())) {
        return Permission::refused("Save the project first: a queued job is read from its file.");
    }
    return job_ready(now);
}

void add_to_queue(ActionContext& context) {
    (void)context.app.queue().open().add(wanted_job(context.now));
    context.view_state.start_at = {};
}

/// A job is made for a controller that plans for itself, or for a machine that is moved here.
Permission suits_machine(const FrameState& now, const jobs::QueuedJob& job) {
    if (!job.has_program) {
        return Permission::refused(
            job.name +
            " was added before Millwright was restarted: \u201cOpen program\u201d reads it again.");
    }
    const bool needs_motion = !(now.connection.connected() && now.connection.can.takes_text());
    return needs_motion == job.has_motion
               ? Permission{}
               : Permission::refused(job.name + " was added for another type of machine: \u201cOpen "
                                                "program\u201d generates it for this one.");
}

/// Of the project's program; nothing is known of any other.
std::string gouges_of(const FrameState& now, const jobs::Job& job) {
    const auto own = now.listing();
    const bool is_own = own && job.listing && own->text == job.listing->text;
    return is_own ? now.gouge_warning() : std::string();
}

void ask_to_start(ActionContext& context, jobs::Job job, std::optional<jobs::QueuedJobId> queued) {
    const std::string gouges =
        !queued && !context.now.in_file() ? context.now.gouge_warning() : gouges_of(context.now, job);
    make_tool_changes(context.now, job);
    StartWish wish = start_wish(std::move(job), queued, context.now.connection);
    wish.gouges = gouges;
    context.app.ask_to_start(std::move(wish));
}

/// From another workspace a key or a command only goes to the machine, so that nothing moves out of sight.
void run_shown(ActionContext& context) {
    if (context.view_state.workspace != Workspace::machine) {
        context.view_state.workspace = Workspace::machine;
    } else if (moves_a_machine(context.now)) {
        ask_to_start(context, wanted_job(context.now), {});
    } else {
        start_job(context, wanted_job(context.now));
    }
}

Permission can_run_next(const FrameState& now) {
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    if (const Permission free = nothing_asked(now); !free.allowed) {
        return free;
    }
    const auto next = std::ranges::find_if(
        now.queue, [](const jobs::QueuedJob& job) { return job.state != jobs::QueueState::done; });
    if (next == now.queue.end()) {
        return Permission::refused("No job is waiting.");
    }
    if (next->state == jobs::QueueState::held) {
        return Permission::refused(next->name + " did not finish successfully and holds the queue: inspect "
                                                "the machine, then release or remove the job.");
    }
    const Permission suits = suits_machine(now, *next);
    const Permission machine = suits.allowed ? machine_ready(now) : suits;
    const Permission ready = machine.allowed ? next_check_passed(now) : machine;
    return ready.allowed ? position_ready(now, next->from_line) : ready;
}

/// The queue hears how it ends; what keeps it from starting holds the queue, too.
void begin_queued(ActionContext& context, jobs::QueuedJobId id) {
    StoredQueue& stored = context.app.queue();
    jobs::JobQueue& queue = stored.open();
    jobs::Job job = queue.begin(id);
    try {
        start_job(context, std::move(job), [&stored](const JobEnding& ending) { stored.enter(ending); });
    } catch (const Error& error) {
        queue.failed(error.what());
        throw;
    }
}

void run_next(ActionContext& context) {
    if (context.view_state.workspace != Workspace::machine) {
        context.view_state.workspace = Workspace::machine;
        context.view_state.lower_tab_now() = LowerTab::queue;
        return;
    }
    jobs::JobQueue& queue = context.app.queue().open();
    const jobs::QueuedJobId id = queue.next().value().id;
    if (!moves_a_machine(context.now)) {
        begin_queued(context, id);
    } else if (const auto job = queue.program_of(id)) {
        ask_to_start(context, *job, id);
    }
}

/// What was asked may have come to nothing meanwhile: the link, the machine's state, its position.
Permission can_start(const FrameState& now) {
    if (!now.view_state.start) {
        return Permission::refused("No job is waiting to be started.");
    }
    if (!moves_a_machine(now)) {
        return Permission::refused("The machine is no longer connected.");
    }
    if (now.job.running) {
        return Permission::refused("A job is running.");
    }
    if (!now.start_check || now.start_check->wish != now.view_state.start) {
        return Permission::refused("The program is being checked.");
    }
    if (!now.start_check->faults.empty()) {
        return Permission::refused(to_text(now.start_check->faults.front()));
    }
    const Permission ready = machine_ready(now);
    return ready.allowed ? position_ready(now, now.view_state.start->job->from_line) : ready;
}

void start_asked(ActionContext& context) {
    const auto wish = std::exchange(context.view_state.start, nullptr);
    if (wish->queued) {
        begin_queued(context, *wish->queued);
    } else {
        start_job(context, *wish->job);
    }
}

Permission can_check_there(const FrameState& now) {
    const bool reads =
        now.view_state.start && now.view_state.start->job->listing && now.connection.can.program.check_mode;
    return reads ? machine_ready(now) : Permission::refused("This controller has no check mode.");
}

void check_there(ActionContext& context) {
    context.app.connection().tell([&context](drivers::Driver& driver) {
        const jobs::Job& job = *context.view_state.start->job;
        const jobs::Job read = jobs::text_job(jobs::controller_text(job), job.project);
        context.view_state.start_answer = driver.check_there(job.tool_change ? *read.listing : *job.listing);
    });
}

Permission can_trace(const FrameState& now) {
    return now.connection.can.takes_text() && now.connection.can.dialect
               ? can_start(now)
               : Permission::refused("This controller does not execute G-code itself.");
}

/// The job stays as it is: it is asked for again afterwards.
void trace_box(ActionContext& context) {
    jobs::Job trace =
        jobs::box_trace_job(*context.view_state.start->job, context.now.start_check->program_check);
    context.view_state.start.reset();
    start_job(context, std::move(trace));
}

void leave_start(ActionContext& context) {
    const drivers::CommandAnswer& answer = context.now.connection.status.answer;
    if (answer.number == context.view_state.start_answer &&
        answer.state == drivers::CommandAnswer::State::pending) {
        context.app.connection().tell([](drivers::Driver& driver) { driver.stop(); });
    }
    context.view_state.start.reset();
}

Permission can_stop_at_once(const FrameState& now) {
    const bool moves = now.job.running || now.connection.connected() || now.plot.table().playing();
    return moves ? Permission{} : Permission::refused("No machine is connected.");
}

void stop_at_once(ActionContext& context) {
    context.app.arm().call_off_path_motion();
    context.app.plot().table().emergency_stop();
    context.app.connection().emergency_stop();
    context.jobs.emergency_stop();
}

} // namespace

void add_queue_actions(Actions& actions) {
    add(actions,
        {"queue.add",
         "Machine",
         "Add to the queue",
         "Adds the program that is shown to the end of the queue. Nothing moves.",
         "",
         icons::program},
        can_add,
        add_to_queue);
    add(actions,
        {"queue.run_next",
         "Machine",
         "Run the next job",
         "Starts the first waiting job. The next one waits until you run this command again.",
         "",
         icons::play},
        can_run_next,
        run_next);
    add(
        actions,
        {"queue.remove_done",
         "Machine",
         "Remove finished jobs",
         "Removes finished jobs from the queue; their logs are kept.",
         "",
         icons::cancel},
        [](const FrameState& now) {
            const bool any = std::ranges::any_of(
                now.queue, [](const jobs::QueuedJob& job) { return job.state == jobs::QueueState::done; });
            return any ? Permission{} : Permission::refused("No job is finished.");
        },
        [](ActionContext& context) { context.app.queue().open().remove_done(); });
}

namespace {

void add_start(Actions& actions) {
    add(actions,
        {"machine.run",
         "Machine",
         "Run the program",
         "Sends the program to the connected machine after you confirm, or else to a virtual one. In other "
         "workspaces, opens it in the Machine workspace.",
         "F9",
         icons::play},
        can_run_job,
        run_shown);
    add(actions,
        {"start.go", dialog_menu, "Start", "The machine moves. Enter does the same.", "", icons::play},
        can_start,
        start_asked);
    add(actions,
        {"start.check",
         dialog_menu,
         "Check on the controller",
         "The controller reads the program in its check mode and reports what it rejects. Nothing moves.",
         "",
         icons::check},
        can_check_there,
        check_there);
    add(actions,
        {"start.trace",
         dialog_menu,
         "Trace bounding box",
         "Moves the machine once around the bounding box of the cuts, at the program's greatest height with "
         "the spindle off: check that no clamps are in the way.",
         "",
         icons::fit_view},
        can_trace,
        trace_box);
    add(actions, {"start.cancel", dialog_menu, "Cancel", "Nothing moves.", "", ""}, always, leave_start);
}

void add_running_job(Actions& actions) {
    add(actions,
        {"machine.hold",
         "Machine",
         "Hold",
         "Brakes along the path; the job can be resumed.",
         "F10",
         icons::hold},
        moves_in<DriverState::running>,
        hold);
    add(actions,
        {"machine.resume", "Machine", "Resume", "Continues where it was held.", "F11", icons::play},
        moves_in<DriverState::holding>,
        resume);
    add(actions,
        {"machine.stop",
         "Machine",
         "Stop",
         "Brakes along the path and ends the job or the manual motion.",
         "F12",
         icons::stop},
        can_stop,
        stop);
    add(actions,
        {"machine.emergency_stop", "Machine", "Emergency stop", "Stops immediately.", "F8", icons::danger},
        can_stop_at_once,
        stop_at_once);
}

} // namespace

void add_machine_actions(Actions& actions) {
    add_start(actions);
    add_running_job(actions);
}

} // namespace millwright::actions
