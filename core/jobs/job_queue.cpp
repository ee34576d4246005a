#include "core/jobs/job_queue.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/jobs/internal/queue_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::jobs {

namespace {

std::string hash_of(const Job& job) {
    return job.hash.empty() ? program_hash(job.listing->text) : job.hash;
}

bool unfinished(const QueuedJob& job) {
    return job.state != QueueState::done;
}

} // namespace

std::string_view to_text(QueueState state) {
    switch (state) {
    case QueueState::waiting:
        return "waiting";
    case QueueState::running:
        return "running";
    case QueueState::done:
        return "done";
    case QueueState::held:
        return "held";
    }
    return "unknown";
}

JobQueue::JobQueue() = default;

JobQueue::JobQueue(std::filesystem::path file) : file_(std::move(file)) {
    expects(!file_.empty(), "a queue on disk has a file");
    make_folder(std::filesystem::absolute(file_).parent_path());
    lock_ = std::make_unique<internal::FileLock>(file_);
    if (!std::filesystem::exists(file_)) {
        return;
    }
    for (QueuedJob& job : internal::read_queue(file_)) {
        last_id_ = std::max(last_id_, static_cast<int>(job.id));
        entries_.push_back({std::move(job), {}, nullptr});
    }
}

JobQueue::~JobQueue() = default;

std::vector<QueuedJob> JobQueue::jobs() const {
    const std::scoped_lock lock(mutex_);
    return shown(entries_);
}

std::vector<QueuedJob> JobQueue::shown(const Entries& entries) {
    std::vector<QueuedJob> all;
    for (const Entry& entry : entries) {
        all.push_back(entry.shown);
    }
    return all;
}

std::optional<QueuedJob> JobQueue::first_unfinished() const {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find_if(entries_, unfinished, &Entry::shown);
    return found == entries_.end() ? std::nullopt : std::optional(found->shown);
}

std::optional<QueuedJob> JobQueue::next() const {
    const std::optional<QueuedJob> first = first_unfinished();
    return first && first->state == QueueState::waiting ? first : std::nullopt;
}

std::shared_ptr<const Job> JobQueue::program_of(QueuedJobId id) const {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find_if(entries_, [&](const Entry& one) { return one.shown.id == id; });
    if (found == entries_.end()) {
        throw Error("that job is no longer in the queue");
    }
    return found->job;
}

std::optional<QueuedJob> JobQueue::held() const {
    const std::optional<QueuedJob> first = first_unfinished();
    return first && first->state == QueueState::held ? first : std::nullopt;
}

void JobQueue::write(const Entries& entries) const {
    if (!file_.empty()) {
        write_file(file_, internal::queue_text(shown(entries)));
    }
}

/// On a copy, which counts once it is on disk.
template <class Change> void JobQueue::change(Change&& how) {
    const std::scoped_lock lock(mutex_);
    Entries changed = entries_;
    how(changed);
    write(changed);
    entries_ = std::move(changed);
}

JobQueue::Entry& JobQueue::entry(Entries& entries, QueuedJobId id) {
    const auto found =
        std::ranges::find_if(entries, [id](const Entry& entry) { return entry.shown.id == id; });
    if (found == entries.end()) {
        throw Error("this job is no longer in the queue");
    }
    return *found;
}

QueuedJobId JobQueue::add(Job job) {
    expects(job.listing != nullptr, "a job has a listing");
    QueuedJobId id{};
    change([&](Entries& entries) {
        id = QueuedJobId{++last_id_};
        QueuedJob shown;
        shown.id = id;
        shown.name = job.name;
        shown.project = lasting_name(job.project);
        shown.hash = hash_of(job);
        shown.blocks = job.block_count();
        shown.from_line = job.from_line;
        shown.has_motion = job.program != nullptr;
        entries.push_back({std::move(shown), {}, std::make_shared<const Job>(std::move(job))});
    });
    return id;
}

void JobQueue::load(QueuedJobId id, Job job) {
    expects(job.listing != nullptr, "a job has a listing");
    change([&](Entries& entries) {
        Entry& found = entry(entries, id);
        if (found.shown.state != QueueState::waiting && found.shown.state != QueueState::held) {
            throw Error(fmt::format(
                "{} is {}: its program cannot be changed", found.shown.name, to_text(found.shown.state)));
        }
        if (found.shown.hash != hash_of(job)) {
            throw Error(fmt::format("{} is not the program that was queued", found.shown.name),
                        {},
                        "remove the old one from the queue and add this one");
        }
        found.shown.blocks = job.block_count();
        found.shown.from_line = job.from_line;
        found.shown.has_program = true;
        found.shown.has_motion = job.program != nullptr;
        found.job = std::make_shared<const Job>(std::move(job));
    });
}

void JobQueue::move(QueuedJobId id, int place) {
    change([&](Entries& entries) {
        if (entry(entries, id).shown.state != QueueState::waiting) {
            throw Error("only a waiting job can be moved");
        }
        std::vector<std::size_t> places; // of the waiting ones
        Entries waiting;
        for (std::size_t n = 0; n < entries.size(); ++n) {
            if (entries[n].shown.state == QueueState::waiting) {
                places.push_back(n);
                waiting.push_back(entries[n]);
            }
        }
        const auto from =
            std::ranges::find_if(waiting, [id](const Entry& one) { return one.shown.id == id; });
        const auto to = waiting.begin() + std::clamp<std::ptrdiff_t>(place, 0, std::ssize(waiting) - 1);
        if (from < to) {
            std::rotate(from, from + 1, to + 1);
        } else {
            std::rotate(to, from, from + 1);
        }
        for (std::size_t n = 0; n < places.size(); ++n) {
            entries[places[n]] = waiting[n];
        }
    });
}

void JobQueue::remove(QueuedJobId id) {
    change([&](Entries& entries) {
        if (entry(entries, id).shown.state == QueueState::running) {
            throw Error("the job is running", {}, "stop it first");
        }
        std::erase_if(entries, [id](const Entry& entry) { return entry.shown.id == id; });
    });
}

void JobQueue::remove_done() {
    change([](Entries& entries) {
        std::erase_if(entries, [](const Entry& entry) { return !unfinished(entry.shown); });
    });
}

void JobQueue::release(QueuedJobId id) {
    change([&](Entries& entries) {
        QueuedJob& job = entry(entries, id).shown;
        if (job.state == QueueState::held) {
            job.state = QueueState::waiting;
        }
    });
}

Job JobQueue::begin(QueuedJobId id) {
    std::shared_ptr<const Job> job;
    change([&](Entries& entries) {
        Entry& wanted = entry(entries, id);
        const auto first = std::ranges::find_if(entries, unfinished, &Entry::shown);
        if (first == entries.end() || first->shown.id != id) {
            const bool held = first != entries.end() && first->shown.state == QueueState::held;
            throw Error(fmt::format("{} is not the next job", wanted.shown.name),
                        {},
                        held ? first->shown.name + " holds the queue: " + first->shown.sentence : "");
        }
        if (wanted.shown.state != QueueState::waiting) {
            throw Error(fmt::format("{} is {}", wanted.shown.name, to_text(wanted.shown.state)),
                        {},
                        wanted.shown.sentence);
        }
        if (wanted.job == nullptr) {
            throw Error(fmt::format("the program of {} is not loaded", wanted.shown.name));
        }
        wanted.before = wanted.shown;
        wanted.shown.state = QueueState::running;
        wanted.shown.end.reset();
        wanted.shown.sentence.clear();
        wanted.shown.log_file.clear();
        job = wanted.job;
    });
    return *job;
}

JobOutcome JobQueue::run(QueuedJobId id, const std::function<JobOutcome(const Job&)>& how) {
    const Job job = begin(id);
    try {
        const JobOutcome outcome = how(job);
        ended(outcome);
        return outcome;
    } catch (const std::exception& error) {
        try {
            failed(error.what());
        } catch (const Error&) {
            // On a full disk: then the file still says that it runs, which holds it the next time.
        }
        throw;
    } catch (const Cancelled&) {
        failed("The job was cancelled before it started.");
        throw;
    }
}

void JobQueue::finish(const std::function<void(Entry&)>& how) {
    const std::scoped_lock lock(mutex_);
    const auto found = std::ranges::find_if(
        entries_, [](const Entry& entry) { return entry.shown.state == QueueState::running; });
    expects(found != entries_.end(), "a job that ends has been started");
    how(*found);
    write(entries_);
}

void JobQueue::ended(const JobOutcome& outcome) {
    finish([&](Entry& entry) {
        QueuedJob& job = entry.shown;
        job.state = outcome.end == JobEnd::done ? QueueState::done : QueueState::held;
        job.end = outcome.end;
        job.sentence = outcome.sentence;
        job.log_file = outcome.log_file;
    });
}

/// One that was held before and could not go on keeps what became of it then.
void JobQueue::failed(const std::string& why) {
    constexpr std::string_view again = " It could not continue: ";
    finish([&](Entry& entry) {
        QueuedJob& job = entry.shown;
        const QueuedJob& before = entry.before;
        job.state = QueueState::held;
        job.end = before.end;
        job.log_file = before.log_file;
        job.sentence = before.sentence.empty() ? why
                                               : before.sentence.substr(0, before.sentence.find(again)) +
                                                     std::string(again) + why;
    });
}

} // namespace millwright::jobs
