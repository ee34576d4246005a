#include "ui/workspaces/stored_queue.h"

#include "core/base/error.h"

#include <system_error>
#include <utility>

namespace millwright::actions {

StoredQueue::StoredQueue(std::filesystem::path file) : file_(std::move(file)) {
    std::error_code unknown;
    if (!std::filesystem::exists(file_, unknown)) {
        return;
    }
    try {
        (void)open();
        rest();
    } catch (const Error&) { // it is the problem
    }
}

std::vector<jobs::QueuedJob> StoredQueue::jobs() const {
    return queue_ ? queue_->jobs() : std::vector<jobs::QueuedJob>{};
}

jobs::JobQueue& StoredQueue::open() {
    if (!queue_) {
        try {
            queue_ = std::make_unique<jobs::JobQueue>(file_);
            problem_.reset();
        } catch (const Error& error) {
            problem_ = error.diagnostic();
            throw;
        }
    }
    return *queue_;
}

void StoredQueue::rest() {
    if (queue_ && queue_->jobs().empty()) {
        queue_.reset();
    }
}

void StoredQueue::enter(const JobEnding& ending) noexcept {
    try {
        if (ending.outcome) {
            queue_->ended(*ending.outcome);
        } else {
            queue_->failed(ending.failure);
        }
    } catch (const Error& error) {
        const std::scoped_lock lock(mutex_);
        failure_ = error.diagnostic();
    }
}

std::optional<Diagnostic> StoredQueue::take_failure() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(failure_, std::nullopt);
}

} // namespace millwright::actions
