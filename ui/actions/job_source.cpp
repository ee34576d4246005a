#include "ui/actions/job_source.h"

#include "core/base/error.h"
#include "ui/actions/workbench.h"

namespace millwright::actions {

namespace {

using widgets::Permission;

/// Nothing but the text is needed where the controller plans for itself.
bool sends_text(const Workbench& now) {
    return now.controller.connected() && now.controller.can.plans;
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

machine::Job file_job(const JobSource& source) {
    const project::OpenedProgram& opened = *source.opened;
    if (source.as_text) {
        return machine::text_job(std::string(opened.text->bytes.text()), opened.file);
    }
    machine::Job job;
    job.machine = source.machine;
    job.program = opened.motion->program;
    job.listing = opened.motion->listing;
    return job;
}

machine::Job project_job(const JobSource& source) {
    const project::Plan& plan = source.plan->plan;
    if (source.as_text) {
        return machine::text_job(plan.listing->text, source.name + ".ngc");
    }
    machine::Job job;
    job.machine = source.machine;
    job.program = plan.program;
    job.listing = plan.listing;
    return job;
}

} // namespace

Permission program_ready(const Workbench& now) {
    if (now.in_file()) {
        if (!now.opened->finished || !now.opened->text) {
            return Permission::refused("The program is being read.");
        }
        if (!now.opened->errors.empty()) {
            return Permission::refused("The program has errors.");
        }
        return sends_text(now) || now.opened->motion ? Permission{}
                                                     : Permission::refused(now.opened->no_motion);
    }
    if (!now.program() || !now.trajectory() || !now.listing()) {
        return Permission::refused("There is no program yet.");
    }
    return now.plan->exact ? Permission{} : Permission::refused("The program is still being computed.");
}

Permission job_ready(const Workbench& now) {
    const Permission program = program_ready(now);
    return program.allowed ? approach_ready(now) : program;
}

JobSource job_source(const Workbench& now) {
    expects(program_ready(now).allowed, "there is a program");
    JobSource source;
    source.as_text = sends_text(now);
    source.machine = source.as_text ? nullptr : now.machine();
    if (now.in_file()) {
        source.opened = now.opened;
        source.file = now.opened->file;
    } else {
        source.plan = now.plan;
        source.file = now.document.file;
    }
    source.name = source.file.empty() ? now.project.name : source.file.stem().string();
    return source;
}

machine::Job make_job(const JobSource& source) {
    machine::Job job = source.opened ? file_job(source) : project_job(source);
    job.name = source.name;
    job.project = source.file.empty() ? source.name : source.file.string();
    return job;
}

machine::Job wanted_job(const Workbench& now) {
    return now.session.begin.on ? *now.approach->job : make_job(job_source(now));
}

} // namespace millwright::actions
