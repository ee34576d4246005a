// The job queue of a folder, for as long as there is something in it: the same file as the command line's,
// so that what waits outlives the window, and either can go on with it.
#pragma once

#include "core/jobs/job_queue.h"
#include "ui/workspaces/job_runner.h"

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace millwright::actions {

class StoredQueue {
public:
    /// Takes what `file` holds, if it is there; problem() says why that came to nothing.
    explicit StoredQueue(std::filesystem::path file);

    /// In their order; none while the file is not open.
    [[nodiscard]] std::vector<jobs::QueuedJob> jobs() const;
    /// Of the file: it is in use by another program, or it is no queue.
    [[nodiscard]] const std::optional<Diagnostic>& problem() const { return problem_; }

    /// Opened first where it is not open. Throws Error with place and reason.
    [[nodiscard]] jobs::JobQueue& open();
    /// Lets other programs have the file while nothing is in the queue.
    void rest();

    /// The job that runs has ended. From any thread; throws nothing.
    void enter(const JobEnding& ending) noexcept;
    /// Why enter() could not write it; once.
    [[nodiscard]] std::optional<Diagnostic> take_failure();

private:
    std::filesystem::path file_;
    std::unique_ptr<jobs::JobQueue> queue_; ///< null: not open
    std::optional<Diagnostic> problem_;
    std::mutex mutex_; ///< guards what follows
    std::optional<Diagnostic> failure_;
};

} // namespace millwright::actions
