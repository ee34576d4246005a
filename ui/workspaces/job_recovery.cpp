#include "ui/workspaces/job_recovery.h"

#include "core/base/error.h"

#include <utility>

namespace millwright::actions {

JobRecovery::JobRecovery(std::filesystem::path folder, std::function<void()> wake)
    : thread_([this, folder = std::move(folder), wake = std::move(wake)] { look(folder, wake); }) {}

/// A log that cannot be read is no reason to ask at the start; `millwright jobs` names it.
void JobRecovery::look(const std::filesystem::path& folder, const std::function<void()>& wake) {
    Stories found = jobs::read_job_folder(folder).jobs;
    std::erase_if(found, [](const jobs::JobStory& story) { return !story.broken_off() || story.seen; });
    if (found.empty()) {
        return;
    }
    {
        const std::scoped_lock lock(mutex_);
        broken_ = std::make_shared<const Stories>(std::move(found));
    }
    wake();
}

std::shared_ptr<const JobRecovery::Stories> JobRecovery::broken() const {
    const std::scoped_lock lock(mutex_);
    return broken_;
}

void JobRecovery::dismiss() {
    const auto stories = broken();
    expects(!stories->empty(), "a job was broken off");
    jobs::mark_seen(stories->front().log_file);
    drop_first();
}

void JobRecovery::later() {
    const std::scoped_lock lock(mutex_);
    broken_ = std::make_shared<const Stories>();
}

void JobRecovery::drop_first() {
    const std::scoped_lock lock(mutex_);
    broken_ = std::make_shared<const Stories>(broken_->begin() + 1, broken_->end());
}

void JobRecovery::wait_idle() {
    if (thread_.joinable()) {
        thread_.join();
    }
}

} // namespace millwright::actions
