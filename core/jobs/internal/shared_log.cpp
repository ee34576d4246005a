#include "core/jobs/internal/shared_log.h"

#include <algorithm>
#include <utility>

namespace millwright::jobs::internal {

SharedLog::SharedLog(JobLog& log, const Clock& clock, double start, int blocks, LogRecord before)
    : log_(log), clock_(clock), start_(start), blocks_(blocks), last_(std::move(before)), since_(start) {}

void SharedLog::write(const LogRecord& record) {
    const std::scoped_lock lock(mutex_);
    try {
        log_.write(record);
    } catch (...) {
        failure_ = failure_ ? failure_ : std::current_exception();
        throw;
    }
    last_ = record;
}

int SharedLog::allow(int wanted) noexcept {
    const std::scoped_lock lock(mutex_);
    if (closed_ || failure_ || wanted <= allowed_) {
        return allowed_;
    }
    try {
        const double now = clock_.now();
        LogRecord ahead;
        ahead.event = LogEvent::ahead;
        ahead.time = std::max(0.0, now - start_);
        ahead.executed_blocks = last_.executed_blocks;
        ahead.line = last_.line;
        ahead.position = last_.position;
        ahead.position_doubt = last_.position_doubt;
        ahead.allowed_blocks = std::min(wanted + sent_soon(wanted, now), blocks_);
        log_.write(ahead);
        allowed_ = ahead.allowed_blocks;
    } catch (...) {
        failure_ = std::current_exception();
    }
    return allowed_;
}

/// At the rate of the last tenths of a second. What fills the controller's buffer at the start is no rate.
int SharedLog::sent_soon(int wanted, double now) {
    constexpr double soon = 0.02;      // s
    constexpr double shortest = 0.1;   // s over which a rate is taken
    constexpr double longest = 0.3;    // s
    constexpr double most_ahead = 100; // blocks
    const double elapsed = now - since_;
    const double rate = (wanted - wanted_then_) / std::max(elapsed, shortest);
    if (elapsed > longest) {
        since_ = now - shortest;
        wanted_then_ = wanted - static_cast<int>(rate * shortest);
    }
    return static_cast<int>(std::clamp(rate * soon, 0.0, most_ahead));
}

void SharedLog::rethrow_failure() const {
    const std::scoped_lock lock(mutex_);
    if (failure_) {
        std::rethrow_exception(failure_);
    }
}

void SharedLog::close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
}

} // namespace millwright::jobs::internal
