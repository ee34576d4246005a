// The log of a running job as two threads write it: the dispatcher what has happened, the driver's thread
// what it is about to send.
#pragma once

#include "core/base/clock.h"
#include "core/jobs/job_log.h"

#include <exception>
#include <mutex>

namespace millwright::jobs::internal {

class SharedLog {
public:
    /// `log` and `clock` must live until close(). `start`: clock time at which the job began; `blocks`: of
    /// the job; `before`: what is known before anything has happened.
    SharedLog(JobLog& log, const Clock& clock, double start, int blocks, LogRecord before);

    /// Throws JobLogError as JobLog::write() does; then nothing more is allowed.
    void write(const LogRecord& record);
    /// Says in the log that blocks up to `wanted` may be sent, and as many more as are sent in a fiftieth of
    /// a second, so that a fast stream does not write a line for each block. How many may be sent: fewer than
    /// wanted if the log could not be written, or is closed.
    [[nodiscard]] int allow(int wanted) noexcept;
    /// Throws what kept allow() from writing.
    void rethrow_failure() const;
    /// Nothing is written any more.
    void close();

private:
    [[nodiscard]] int sent_soon(int wanted, double now);

    mutable std::mutex mutex_; ///< guards all below
    JobLog& log_;
    const Clock& clock_;
    double start_;
    int blocks_;
    LogRecord last_;
    bool closed_ = false;
    int allowed_ = 0;
    double since_ = 0.0; ///< clock time from which the rate is taken
    int wanted_then_ = 0;
    std::exception_ptr failure_;
};

} // namespace millwright::jobs::internal
