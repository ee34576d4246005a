// One thread that does one job after the other, in the order in which they came.
#pragma once

#include "core/base/progress.h"
#include "core/plan/pipeline.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace millwright::plan {

/// All public members may be called from any thread but the worker's.
class Background {
public:
    /// May throw Cancelled; what else goes wrong it has to deal with itself.
    using Job = std::function<void(const Progress&)>;

    /// `wake` is called from the worker when its activity changed visibly.
    explicit Background(std::function<void()> wake);
    Background(const Background&) = delete;
    Background& operator=(const Background&) = delete;
    /// Drops what waits, stops what runs.
    ~Background();

    void append(Job job);
    /// Drops what waits and stops what runs, which is over when its next check comes.
    void clear();
    /// Both at once, so that no idle moment is visible in between.
    void replace(Job job);
    /// Like clear(), with a job that closes what was stopped; until then it is stopping.
    void end_with(Job job);

    [[nodiscard]] Activity activity() const;
    void wait_idle() const;

private:
    void work(const std::stop_token& quit);
    void put_in_place(Job job, bool closes); ///< of all that wait and run, under the lock
    void listen(const Progress::Report& report);

    std::function<void()> wake_;
    mutable std::mutex mutex_;
    mutable std::condition_variable_any changed_;
    std::deque<Job> jobs_;
    bool closes_ = false; ///< the first of them closes what was stopped
    bool working_ = false;
    Activity activity_;
    std::stop_source running_;
    std::jthread thread_; // last: nothing of the above goes before it has ended
};

} // namespace millwright::plan
