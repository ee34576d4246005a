// A job on its way: what is seen of it, its log, and how it ended.
#pragma once

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/drivers/driver.h"
#include "core/jobs/internal/position_estimate.h"
#include "core/jobs/job.h"
#include "core/jobs/job_log.h"
#include "core/jobs/job_report.h"
#include "core/motion/trajectory.h"

#include <cstddef>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace millwright::jobs::internal {

// The log of a running job as two threads write it: the dispatcher what has happened, the driver's thread
// what it is about to send.

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

inline constexpr double poll_time = 0.02; // s: a fifth of what a person notices

/// Whether nothing moves any more in this state.
[[nodiscard]] bool ended(drivers::DriverState state);

/// s; 0 where the controller alone plans.
[[nodiscard]] double planned_time(const Job& job, const motion::Trajectory* trajectory);

/// What somebody wanted while a job was running.
struct JobRequest {
    LogEvent event = LogEvent::hold;
    double clock_time = 0.0;
    drivers::DriverStatus status; ///< when it was made
    std::string text;             ///< what was wanted
};

/// Whom a running job turns to.
struct JobSurroundings {
    drivers::Driver& driver;
    Clock& clock;
    std::function<std::vector<JobRequest>()> take_requests; ///< those since it was called last
    std::function<void()> stop;                             ///< by its user, with an entry in the log
};

class RunningJob {
public:
    /// What is named by reference outlives it. `trajectory`: null where the controller alone plans.
    RunningJob(JobSurroundings around,
               const Job& job,
               JobLog& log,
               std::shared_ptr<const motion::Trajectory> trajectory,
               drivers::DriverStatus before,
               PositionEnvelope envelope,
               PathEstimate estimate);
    RunningJob(const RunningJob&) = delete;
    RunningJob& operator=(const RunningJob&) = delete;
    ~RunningJob() { log_->close(); }

    /// For a piecewise driver, which may keep it longer than this lives: what a log does not allow has not
    /// been sent.
    [[nodiscard]] std::function<int(int)> ahead() const {
        return [log = log_](int wanted) { return log->allow(wanted); };
    }

    JobOutcome to_the_end(const Progress& progress, const std::function<void(const JobReport&)>& listener);
    /// The last line of a job that ends by our own failure, if it still can be written.
    void log_failure(const std::string& why) noexcept;
    /// The same for a log that took no more lines; what there is to say of it. The machine is at rest.
    [[nodiscard]] Diagnostic log_lost(const std::string& reason);

private:
    void write_end(std::string text);
    [[nodiscard]] double elapsed() const { return clock_.now() - start_; }
    [[nodiscard]] int blocks() const { return job_.block_count(); }
    void remember(const drivers::DriverStatus& status);
    void estimate_place(const drivers::DriverStatus& status);
    [[nodiscard]] double planned() const { return planned_time(job_, trajectory_.get()); }
    [[nodiscard]] double time_of_place() const;
    [[nodiscard]] LogRecord record(LogEvent event, double time, const drivers::DriverStatus& status) const;
    void watch_reach(const drivers::DriverStatus& status);
    void write_requests();
    void write_executed();
    void write_own_lines();
    void write_waiting();
    void tell(const Progress& progress, const std::function<void(const JobReport&)>& listener) const;
    [[nodiscard]] int line_of(int block) const;
    [[nodiscard]] JobEnd end_of(const drivers::DriverStatus& status) const;
    JobOutcome outcome(const drivers::DriverStatus& status);

    drivers::Driver& driver_;
    Clock& clock_;
    std::function<std::vector<JobRequest>()> take_requests_;
    std::function<void()> stop_;
    const Job& job_;
    std::filesystem::path file_; ///< of the log
    std::shared_ptr<const motion::Trajectory> trajectory_;
    PositionEnvelope envelope_;
    PathEstimate estimate_;
    std::string beyond_; ///< what was seen of a machine that left the reach; empty: nothing
    drivers::Capabilities able_;
    double start_ = 0.0;
    drivers::DriverStatus
        last_; ///< with the last known position where the link is gone, or the position is lost
    std::string doubt_before_;
    std::shared_ptr<SharedLog> log_;
    int logged_blocks_ = 0;
    std::size_t own_lines_ = 0; ///< that are in the log
    bool cancelled_ = false;
    std::string waits_for_; ///< a person, and why; empty: does not wait
};

} // namespace millwright::jobs::internal
