#include "ui/workspaces/job_source.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/workspaces/frame_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace millwright::actions {

namespace {

using widgets::Permission;

/// Nothing but the text is needed where the controller plans for itself.
bool sends_text(const FrameState& now) {
    return now.connection.connected() && now.connection.can.takes_text();
}

/// Where it is to begin at a line, what comes before is known and was shown.
Permission approach_ready(const FrameState& now) {
    if (!now.view_state.start_at.on) {
        return {};
    }
    if (!now.approach || !(now.approach->wish.begin == now.view_state.start_at)) {
        return Permission::refused("The approach to the line is being computed.");
    }
    return now.approach->refusal ? Permission::refused(to_text(*now.approach->refusal)) : Permission{};
}

/// Letters of the axes that the shown program positions; empty where that is not known.
std::string moved_axes(const FrameState& now) {
    if (now.in_file()) {
        return now.opened->motion ? now.opened->motion->moved_axes : "";
    }
    std::string letters;
    if (const auto program = now.program()) {
        for (const program::ProgramAxis& axis : program->axes) {
            letters += axis.letter;
        }
    }
    return letters;
}

/// "X", "X and Y", "X, Y and Z"
std::string listed(std::string_view letters) {
    std::string text;
    for (std::size_t n = 0; n < letters.size(); ++n) {
        text += n == 0 ? "" : n + 1 == letters.size() ? " and " : ", ";
        text += letters[n];
    }
    return text;
}

jobs::Job file_job(const JobSource& source) {
    const plan::OpenedProgram& opened = *source.opened;
    if (source.as_text) {
        return jobs::text_job(std::string(opened.text->text()), opened.file);
    }
    jobs::Job job;
    job.machine = source.machine;
    job.program = opened.motion->program;
    job.listing = opened.motion->listing;
    return job;
}

jobs::Job project_job(const JobSource& source) {
    const plan::Plan& plan = source.plan->plan;
    if (source.as_text) {
        return jobs::text_job(plan.listing->text, source.name + ".ngc");
    }
    jobs::Job job;
    job.machine = source.machine;
    job.program = plan.program;
    job.listing = plan.listing;
    return job;
}

} // namespace

Permission refused_for(const std::vector<Diagnostic>& faults) {
    if (faults.empty()) {
        return {};
    }
    Diagnostic first = faults.front();
    first.place.file = first.place.file.filename();
    if (faults.size() > 1) {
        first.message += fmt::format("; and {} more", faults.size() - 1);
    }
    const std::string text = to_text(first);
    return Permission::refused(first.place.file.empty() ? as_sentence(text) : with_full_stop(text));
}

Permission program_ready(const FrameState& now) {
    if (now.in_file()) {
        if (!now.opened->finished || !now.opened->text) {
            return Permission::refused("The program is being read.");
        }
        if (!now.opened->errors.empty()) {
            return refused_for(now.opened->errors);
        }
        if (sends_text(now)) {
            return {};
        }
        const bool real =
            now.connection.connected() && now.connection.choice.driver != machine::virtual_driver;
        if (real && !now.opened->unplaced.empty()) { // it has no work offsets of its own
            return Permission::refused(to_text(now.opened->unplaced.front()));
        }
        if (!now.opened->faults.empty()) { // its moves are without what this machine cannot do
            return refused_for(now.opened->faults);
        }
        return now.opened->motion ? Permission{} : Permission::refused(now.opened->no_motion);
    }
    if (!now.program() || !now.trajectory() || !now.listing()) {
        return Permission::refused("There is no program yet.");
    }
    return now.plan->program_exact && now.program_is_current()
               ? Permission{}
               : Permission::refused("The program is still being computed.");
}

Permission axes_ready(const FrameState& now) {
    const auto& axes = now.connection.axes;
    if (!now.connection.connected() || axes.empty()) {
        return {};
    }
    std::string missing, there;
    for (const char letter : moved_axes(now)) {
        if (std::ranges::find(axes, letter, &program::ProgramAxis::letter) == axes.end()) {
            missing += letter;
        }
    }
    for (const program::ProgramAxis& axis : axes) {
        there += axis.letter;
    }
    return missing.empty()
               ? Permission{}
               : Permission::refused("The program moves " + listed(missing) +
                                     ", but the connected machine has only " + listed(there) +
                                     ". Connect a machine with all of these axes, generate the program for " +
                                     listed(there) + ", or disconnect to run it on the virtual machine.");
}

Permission job_ready(const FrameState& now) {
    const Permission program = program_ready(now);
    return program.allowed ? approach_ready(now) : program;
}

JobSource job_source(const FrameState& now) {
    expects(program_ready(now).allowed, "there is a program");
    JobSource source;
    source.as_text = sends_text(now);
    if (source.as_text) {
        source.tool_change = tool_change_plan(now.view_state.manual, now.connection);
    }
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

jobs::Job make_job(const JobSource& source) {
    jobs::Job job = source.opened ? file_job(source) : project_job(source);
    job.tool_change = source.tool_change;
    job.name = source.name;
    job.project = source.file.empty() ? source.name : source.file.string();
    return job;
}

jobs::Job wanted_job(const FrameState& now) {
    return now.view_state.start_at.on ? *now.approach->job : make_job(job_source(now));
}

} // namespace millwright::actions
