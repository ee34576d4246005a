// The part of AppController that deals with jobs that wait: their programs are read again after a restart, or
// for another machine than the one that they were added for.
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/job_source.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

using jobs::QueuedJob;
using jobs::QueuedJobId;

bool worked_out(const FrameState& now) {
    const bool reading = now.activity.busy || (now.in_file() && !now.opened->finished);
    const bool approached = !now.view_state.start_at.on || !program_ready(now).allowed ||
                            (now.approach && now.approach->wish.begin == now.view_state.start_at);
    return !reading && approached;
}

} // namespace

void AppController::open_queued(QueuedJobId id) {
    const std::vector<QueuedJob> jobs = queue_.jobs();
    const auto found = std::ranges::find(jobs, id, &QueuedJob::id);
    if (found == jobs.end()) {
        throw Error("this job is no longer in the queue");
    }
    const std::filesystem::path file(found->project);
    const StartAt begin =
        found->from_line > 1 ? StartAt{true, found->from_line, std::nullopt, found->hash} : StartAt{};
    const auto read = [file, begin, id](AppController& app) {
        if (file.extension() == ".json") {
            app.close_file();
        }
        app.open(file);
        app.view_state_.workspace = Workspace::machine;
        app.view_state_.start_at = begin;
        app.loading_ = id;
    };
    if (file.extension() == ".json") {
        leave("open " + file.filename().string(), read);
    } else {
        read(*this);
    }
}

void AppController::follow_queue(const FrameState& now) {
    if (const auto failure = queue_.take_failure()) {
        tell(view_state_,
             widgets::Severity::danger,
             with_sentence("The queue could not be written: " + failure->message,
                           "See the job's log for how it ended."),
             failure->place.file.string());
    }
    if (!loading_ || !worked_out(now)) {
        return;
    }
    const QueuedJobId id = *std::exchange(loading_, std::nullopt);
    guarded([&] {
        if (const auto permission = job_ready(now); !permission.allowed) {
            throw Error("The job is still waiting for its program: " + permission.reason);
        }
        queue_.open().load(id, wanted_job(now));
        view_state_.start_at = {};
        tell(view_state_,
             widgets::Severity::good,
             "The program was read again; start it with \u201cRun next\u201d.");
    });
}

} // namespace millwright::actions
