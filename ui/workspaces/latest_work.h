// Something that is worked out in the background each time that what it is made of has changed: the newest
// wish counts, and the last answer stays until there is a newer one, so that what follows a dragging hand
// moves.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>
#include <utility>

namespace millwright::actions {

template <class Wish, class Answer> class LatestWork {
public:
    using Work = std::function<Answer(const Wish&, const Progress&)>;

    /// `work` runs in a thread of its own, `wake` is called from there when there is an answer. What `work`
    /// throws but Cancelled ends the program: faults belong into the answer.
    LatestWork(Work work, std::function<void()> wake)
        : work_(std::move(work)), wake_(std::move(wake)),
          thread_([this](const std::stop_token& stop) { run(stop); }) {}
    LatestWork(const LatestWork&) = delete;
    LatestWork& operator=(const LatestWork&) = delete;
    ~LatestWork() { forget(); }

    void want(Wish wish) {
        {
            const std::scoped_lock lock(mutex_);
            wish_ = std::move(wish);
        }
        changed_.notify_all();
    }
    /// Stops what is being done; there is no answer any more.
    void forget() {
        const std::scoped_lock lock(mutex_);
        wish_.reset();
        answer_.reset();
        present_.request_stop();
    }
    /// The newest; null before the first.
    [[nodiscard]] std::shared_ptr<const Answer> answer() const {
        const std::scoped_lock lock(mutex_);
        return answer_;
    }
    [[nodiscard]] bool busy() const {
        const std::scoped_lock lock(mutex_);
        return busy_ || wish_;
    }
    /// How far what is being done has come, as it tells; nothing reported yet: 0 and no text.
    [[nodiscard]] Progress::Report report() const {
        const std::scoped_lock lock(mutex_);
        return report_;
    }
    /// Blocks until nothing is left to do.
    void wait_idle() const {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return !busy_ && !wish_; });
    }

private:
    void run(const std::stop_token& stop) {
        while (true) {
            std::optional<Wish> wish;
            std::stop_source present;
            {
                std::unique_lock lock(mutex_);
                if (!changed_.wait(lock, stop, [this] { return wish_.has_value(); })) {
                    return;
                }
                wish = std::exchange(wish_, std::nullopt);
                present_ = present;
                report_ = {};
                busy_ = true;
            }
            std::shared_ptr<const Answer> found;
            try {
                found = std::make_shared<const Answer>(work_(
                    *wish,
                    Progress([this](const Progress::Report& now) { listen(now); }, present.get_token())));
            } catch (const Cancelled&) { // no longer needed
            }
            {
                const std::scoped_lock lock(mutex_);
                busy_ = false;
                if (found && !present.stop_requested()) {
                    answer_ = std::move(found);
                }
            }
            changed_.notify_all();
            if (wake_) {
                wake_();
            }
        }
    }

    void listen(const Progress::Report& now) {
        constexpr double visible = 0.01; // of a progress bar
        {
            const std::scoped_lock lock(mutex_);
            if (now.text == report_.text && now.fraction < report_.fraction + visible) {
                return;
            }
            report_ = now;
        }
        if (wake_) {
            wake_();
        }
    }

    Work work_;
    std::function<void()> wake_;
    mutable std::mutex mutex_; ///< guards what follows
    mutable std::condition_variable_any changed_;
    std::optional<Wish> wish_;
    std::stop_source present_;
    Progress::Report report_; ///< of the present work
    bool busy_ = false;
    std::shared_ptr<const Answer> answer_;
    std::jthread thread_; // last: it ends before what it uses
};

} // namespace millwright::actions
