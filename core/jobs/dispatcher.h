// Runs a job through a driver: checks before, watches, logs, and says afterwards what was executed for
// certain.
#pragma once

#include "core/base/clock.h"
#include "core/base/progress.h"
#include "core/drivers/driver.h"
#include "core/jobs/job.h"
#include "core/jobs/job_log.h"
#include "core/jobs/job_report.h"

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace millwright::jobs {

namespace internal {
class PathEstimate;
class PositionEnvelope;
class RunningJob;
struct JobRequest;
} // namespace internal

class Dispatcher {
public:
    /// `driver` and `clock` must outlive it. Logs go to `log_folder`.
    Dispatcher(drivers::Driver& driver, Clock& clock, std::filesystem::path log_folder);
    Dispatcher(const Dispatcher&) = delete;
    Dispatcher& operator=(const Dispatcher&) = delete;
    ~Dispatcher();

    using Listener = std::function<void(const JobReport&)>;

    /// Runs the whole job and returns how it ended; blocks, so call it from a thread that may wait.
    /// `listener` is called from that thread. Cancelling `progress` stops the machine. Throws Error before
    /// any motion if something is wrong with job, log folder or driver, or another job is running; if the log
    /// cannot be written any more or the listener throws, stops the machine, says so in the log if that takes
    /// it, and throws Error with what was executed, or passes on what the listener threw. Reports
    /// JobEnd::done only if the driver executed every block.
    JobOutcome run(const Job& asked, const Progress& progress, const Listener& listener = {});

    /// From any thread, at once; entered in the log of the running job.
    void hold();
    void resume();
    void stop();
    /// Throw Error if the driver cannot do it.
    void set_overrides(const drivers::Overrides& wanted);
    void set_single_block(bool on);
    void set_optional_stop(bool on);

private:
    class Turn;

    void request(LogEvent event, std::string text, const std::function<void()>& command);
    void expect_rest(const drivers::DriverStatus& before) const;
    void expect_fit(const Job& job, const drivers::Capabilities& able) const;
    [[nodiscard]] LogStart start_of(const Job& job,
                                    const motion::Trajectory* trajectory,
                                    const drivers::Capabilities& able,
                                    const drivers::DriverStatus& before) const;
    JobOutcome to_the_end(internal::RunningJob& running,
                          drivers::Work work,
                          const Progress& progress,
                          const Listener& listener);
    [[nodiscard]] internal::PositionEnvelope check(const Job& job,
                                                   const drivers::Capabilities& able,
                                                   const drivers::DriverStatus& before,
                                                   internal::PathEstimate& estimate,
                                                   std::optional<drivers::ToolChanges>& changes) const;
    void check_position(const Job& job, const drivers::DriverStatus& status) const;
    [[nodiscard]] std::vector<internal::JobRequest> take_requests();
    void bring_to_rest() noexcept;

    drivers::Driver& driver_;
    Clock& clock_;
    std::filesystem::path log_folder_;
    std::mutex mutex_; ///< guards what follows
    bool running_ = false;
    std::vector<internal::JobRequest> requests_;
};

} // namespace millwright::jobs
