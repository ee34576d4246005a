// The part of the workshop that deals with jobs that wait: their programs are read again after a restart, or
// for another machine than the one that they were added for.
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/actions/job_source.h"
#include "ui/actions/workshop.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

using jobs::QueuedJob;
using jobs::QueuedJobId;

bool worked_out(const Workbench& now) {
    const bool reading = now.activity.busy || (now.in_file() && !now.opened->finished);
    const bool approached = !now.session.begin.on || !program_ready(now).allowed ||
                            (now.approach && now.approach->wish.begin == now.session.begin);
    return !reading && approached;
}

} // namespace

void Workshop::open_queued(QueuedJobId id) {
    const std::vector<QueuedJob> jobs = queue_.jobs();
    const auto found = std::ranges::find(jobs, id, &QueuedJob::id);
    if (found == jobs.end()) {
        throw Error("this job is no longer in the queue");
    }
    const std::filesystem::path file(found->project);
    const BeginAt begin =
        found->from_line > 1 ? BeginAt{true, found->from_line, std::nullopt, found->hash} : BeginAt{};
    const auto read = [file, begin, id](Workshop& workshop) {
        if (file.extension() == ".json") {
            workshop.close_file();
        }
        workshop.open(file);
        workshop.session_.workspace = Workspace::machine;
        workshop.session_.begin = begin;
        workshop.loading_ = id;
    };
    if (file.extension() == ".json") {
        leave("open " + file.filename().string(), read);
    } else {
        read(*this);
    }
}

void Workshop::follow_queue() {
    if (const auto failure = queue_.take_failure()) {
        tell(session_,
             widgets::Severity::danger,
             with_sentence("The queue could not be written: " + failure->message,
                           "See the job's log for how it ended."),
             failure->place.file.string());
    }
    const Workbench now = look();
    if (!loading_ || !worked_out(now)) {
        return;
    }
    const QueuedJobId id = *std::exchange(loading_, std::nullopt);
    guarded([&] {
        if (const auto permission = job_ready(now); !permission.allowed) {
            throw Error("The job is still waiting for its program: " + permission.reason);
        }
        queue_.open().load(id, wanted_job(now));
        session_.begin = {};
        tell(session_,
             widgets::Severity::good,
             "The program was read again; start it with \u201cRun next\u201d.");
    });
}

} // namespace millwright::actions
