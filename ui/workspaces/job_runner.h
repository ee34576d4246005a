// The job on the machine: runs the dispatcher in a thread of its own and keeps its last report for whoever
// looks. hold, resume and stop act at once.
#pragma once

#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace millwright::actions {

/// What is known of the job, for one frame.
struct JobView {
    bool running = false;                            ///< the dispatcher has it
    std::string name;                                ///< empty before the first job
    std::string project;                             ///< file or title it comes from
    std::optional<jobs::JobReport> report;           ///< the last
    std::shared_ptr<const program::Listing> listing; ///< what is sent
    int from_line = 1;                               ///< of the file, as jobs::Job has it
    std::optional<jobs::JobOutcome> outcome;         ///< of the last job that ended
    std::optional<Diagnostic> failure;               ///< it did not start, or its log could not be written
};

/// What a job leaves behind: how it ended, or else why it came to no end.
struct JobEnding {
    std::optional<jobs::JobOutcome> outcome;
    std::string failure; ///< empty where there is an outcome
};

class JobRunner {
public:
    /// Called once from the job's thread when it has ended. Must not throw.
    using Ended = std::function<void(const JobEnding&)>;

    /// `wake` is called from the job's thread whenever there is something new to see.
    JobRunner(std::filesystem::path log_folder, std::function<void()> wake);
    JobRunner(const JobRunner&) = delete;
    JobRunner& operator=(const JobRunner&) = delete;
    /// Stops the machine and waits until it is at rest.
    ~JobRunner();

    /// Starts `job` on a virtual machine at `speed` times real time (0: as fast as can be computed). Throws
    /// Defect if one is running.
    void start(jobs::Job job, double speed, Ended ended = {});
    /// Starts `job` on a connected machine, which stays connected.
    void start(jobs::Job job, std::shared_ptr<drivers::Driver> driver, Ended ended = {});
    void hold();
    void resume();
    void stop();
    void emergency_stop();
    void set_speed(double speed);
    /// Of the running job, and entered in its log; nothing without one. Throw Error if its machine cannot.
    void set_overrides(const drivers::Overrides& wanted);
    void set_single_block(bool on);

    /// The last job's failure is not shown any more: another program is. Does nothing while one runs.
    void forget_failure();
    [[nodiscard]] JobView view() const;
    /// Blocks until no job is running.
    void wait();

private:
    class Run;
    void start(jobs::Job job, std::shared_ptr<drivers::Driver> driver, double speed, Ended ended);

    std::filesystem::path log_folder_;
    std::function<void()> wake_;
    std::unique_ptr<Run> run_;
};

} // namespace millwright::actions
