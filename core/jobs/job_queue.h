// Jobs one after another. Each is begun by a person, and none before all above it are done: a job that ends
// in any other way holds the queue until a person has decided what becomes of it. Nothing here moves a
// machine.
#pragma once

#include "core/jobs/job.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::jobs {

namespace internal {
class FileLock;
}

enum class QueuedJobId : int {};

enum class QueueState {
    waiting, ///<
    running, ///<
    done,    ///<
    held     ///< begun, and not done: nothing below it begins
};

[[nodiscard]] std::string_view to_text(QueueState state);

/// One job of the queue, for people.
struct QueuedJob {
    QueuedJobId id{};
    std::string name, project; ///< of Job
    std::string hash;          ///< of the whole program, as in the job's log
    int blocks = 0;
    int from_line = 1;
    QueueState state = QueueState::waiting;
    std::optional<JobEnd> end;      ///< how it ended when it was last run
    std::string sentence;           ///< what happened then; empty before
    std::filesystem::path log_file; ///< of that run; may be empty
    bool has_program = true;        ///< false: it was read from the file, and load() is due
    bool has_motion = false;        ///< of the program: the positions of its blocks, not its text alone

    friend bool operator==(const QueuedJob&, const QueuedJob&) = default;
};

/// Safe from any thread. Whatever throws has changed nothing, but for what ended.
class JobQueue {
public:
    /// In memory alone.
    JobQueue();
    /// Reads `file` if it is there, and writes it with each change (format: docs/reference/job-log.md); it
    /// belongs to this queue alone. A job that was running when its program ended is held. Throws Error with
    /// place and reason for a file that is no queue, cannot be written, or belongs to another program.
    explicit JobQueue(std::filesystem::path file);
    JobQueue(const JobQueue&) = delete;
    JobQueue& operator=(const JobQueue&) = delete;
    ~JobQueue();

    /// In their order.
    [[nodiscard]] std::vector<QueuedJob> jobs() const;
    /// What can be begun now: the first that is not done, if it waits.
    [[nodiscard]] std::optional<QueuedJob> next() const;
    /// What a job would run; null where load() is due. Throws Error if there is no such job.
    [[nodiscard]] std::shared_ptr<const Job> program_of(QueuedJobId id) const;
    /// The job that holds the queue.
    [[nodiscard]] std::optional<QueuedJob> held() const;

    /// At the end of the queue.
    QueuedJobId add(Job job);
    /// Gives a job that waits or is held its program: the same, or the rest of it from a line. Throws Error
    /// if it is another program than the one that was queued.
    void load(QueuedJobId id, Job job);
    /// A waiting job to `place` among those that wait, 0 being the first; beyond the end: the last.
    void move(QueuedJobId id, int place);
    /// Throws Error while it runs.
    void remove(QueuedJobId id);
    void remove_done();
    /// A person has looked at the machine: the held job waits again, to be run as it is or as load() makes
    /// it.
    void release(QueuedJobId id);

    /// A person's word that this job begins now: `how` runs it, as Dispatcher::run() does, and how that ends
    /// is entered. Anything but JobEnd::done holds the queue. Throws what begin() and `how` throw; what `how`
    /// throws holds the queue too.
    JobOutcome run(QueuedJobId id, const std::function<JobOutcome(const Job&)>& how);

    /// The parts of run(), for callers that have other work meanwhile. Begins: throws Error if the job is not
    /// the one that comes next, if the queue is held, if a job is running, or if the program was not loaded.
    [[nodiscard]] Job begin(QueuedJobId id);
    /// What has happened holds even if it cannot be written: then it throws, and whoever reads the file finds
    /// the job held.
    void ended(const JobOutcome& outcome);
    /// It did not come to an outcome. Holds as ended() does; what was known of a job that was held before
    /// stays.
    void failed(const std::string& why);

private:
    struct Entry {
        QueuedJob shown;
        QueuedJob before;               ///< of a job that was begun: as it was shown until then
        std::shared_ptr<const Job> job; ///< null: not loaded
    };
    using Entries = std::vector<Entry>;

    [[nodiscard]] static std::vector<QueuedJob> shown(const Entries& entries);
    [[nodiscard]] static Entry& entry(Entries& entries, QueuedJobId id);
    [[nodiscard]] std::optional<QueuedJob> first_unfinished() const;
    void write(const Entries& entries) const;
    template <class Change> void change(Change&& how);
    void finish(const std::function<void(Entry&)>& how);

    std::filesystem::path file_; ///< empty: none
    std::unique_ptr<internal::FileLock> lock_;
    mutable std::mutex mutex_; ///< guards what follows
    Entries entries_;
    int last_id_ = 0;
};

} // namespace millwright::jobs
