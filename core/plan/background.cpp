#include "core/plan/internal/background.h"

#include "core/base/error.h"

#include <cstddef>
#include <utility>

namespace millwright::plan {

Background::Background(std::function<void()> wake)
    : wake_(std::move(wake)), thread_([this](const std::stop_token& quit) { work(quit); }) {}

Background::~Background() {
    thread_.request_stop();
    clear();
}

void Background::append(Job job) {
    {
        const std::scoped_lock lock(mutex_);
        jobs_.push_back(std::move(job));
    }
    changed_.notify_all();
}

void Background::clear() {
    const std::scoped_lock lock(mutex_);
    jobs_.clear();
    closes_ = false;
    running_.request_stop();
    changed_.notify_all();
}

void Background::replace(Job job) {
    const std::scoped_lock lock(mutex_);
    put_in_place(std::move(job), false);
}

void Background::end_with(Job job) {
    const std::scoped_lock lock(mutex_);
    put_in_place(std::move(job), true);
}

void Background::put_in_place(Job job, bool closes) {
    jobs_.clear();
    closes_ = closes;
    running_.request_stop();
    jobs_.push_back(std::move(job));
    changed_.notify_all();
}

Activity Background::activity() const {
    const std::scoped_lock lock(mutex_);
    Activity now = activity_;
    now.busy = working_ || !jobs_.empty();
    const std::size_t closing = closes_ ? 1 : 0;
    now.stopping = working_ && jobs_.size() == closing && running_.stop_requested();
    return now;
}

void Background::wait_idle() const {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return jobs_.empty() && !working_; });
}

void Background::work(const std::stop_token& quit) {
    while (true) {
        Job job;
        std::stop_token stop;
        {
            std::unique_lock lock(mutex_);
            if (!changed_.wait(lock, quit, [this] { return !jobs_.empty(); }) || quit.stop_requested()) {
                return;
            }
            job = std::move(jobs_.front());
            jobs_.pop_front();
            closes_ = false;
            running_ = std::stop_source();
            stop = running_.get_token();
            working_ = true;
            activity_ = {};
        }
        try {
            job(Progress([this](const Progress::Report& report) { listen(report); }, stop));
        } catch (const Cancelled&) { // what the job was for is no longer wanted
        }
        job = nullptr; // what it holds is released before the end is reported
        {
            const std::scoped_lock lock(mutex_);
            working_ = false;
            activity_ = {};
        }
        changed_.notify_all();
        wake_();
    }
}

void Background::listen(const Progress::Report& report) {
    constexpr double visible = 0.01; // of a progress bar
    {
        const std::scoped_lock lock(mutex_);
        if (report.text == activity_.text && report.fraction < activity_.fraction + visible) {
            return;
        }
        activity_ = {true, report.fraction, report.text};
    }
    wake_();
}

} // namespace millwright::plan
