#include "core/project/autosave.h"

#include <stop_token>
#include <utility>

namespace millwright::project {

Autosave::Autosave(const std::filesystem::path& folder, std::chrono::milliseconds interval)
    : copy_(folder), interval_(interval), thread_([this](const std::stop_token& stop) { work(stop); }) {}

Autosave::~Autosave() = default;

void Autosave::keep(UnsavedWork work) {
    ask(std::move(work), false);
}

void Autosave::drop() {
    ask(Nothing{}, true);
}

void Autosave::ask(Wanted wanted, bool soon) {
    {
        const std::scoped_lock lock(mutex_);
        wanted_ = std::move(wanted);
        soon_ = soon_ || soon;
    }
    changed_.notify_all();
}

void Autosave::wait_idle() {
    std::unique_lock lock(mutex_);
    soon_ = true;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !wanted_ && !busy_; });
}

std::optional<Diagnostic> Autosave::take_failure() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(failure_, std::nullopt);
}

void Autosave::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, stop, [this] { return wanted_.has_value(); });
        if (!wanted_) {
            return;
        }
        const Wanted wanted = *std::exchange(wanted_, std::nullopt);
        busy_ = true;
        soon_ = false;
        lock.unlock();
        carry_out(wanted);
        lock.lock();
        busy_ = false;
        changed_.notify_all();
        changed_.wait_for(lock, stop, interval_, [this] { return soon_; });
    }
}

void Autosave::carry_out(const Wanted& wanted) {
    try {
        if (const auto* work = std::get_if<UnsavedWork>(&wanted)) {
            copy_.write(*work);
        } else {
            copy_.remove();
        }
    } catch (const Error& error) {
        const std::scoped_lock lock(mutex_);
        failure_ = error.diagnostic();
    }
}

} // namespace millwright::project
