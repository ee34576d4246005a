// Runs a job through a driver: checks before, watches, logs, and says afterwards what was executed for
// certain.
#pragma once

#include "core/base/progress.h"
#include "core/machine/clock.h"
#include "core/machine/driver.h"
#include "core/machine/job.h"

#include <filesystem>
#include <functional>
#include <mutex>

namespace millwright::machine {

/// How a running job stands.
struct JobReport {
    DriverStatus driver;
    int executed_blocks = 0;
    int blocks = 0;
    double elapsed = 0.0;      ///< s since the start
    double planned_time = 0.0; ///< of the whole job, s
};

class Dispatcher {
public:
    /// `driver` and `clock` must outlive it. Logs go to `log_folder`.
    Dispatcher(Driver& driver, Clock& clock, std::filesystem::path log_folder);

    using Listener = std::function<void(const JobReport&)>;

    /// Runs the job to its end and returns how it ended; blocks, so call it from a thread that may wait.
    /// `listener` is called from that thread. Cancelling `progress` stops the machine. Throws Error before
    /// any motion if something is wrong with job, log folder or driver; throws Error after having stopped the
    /// machine if the log cannot be written any more. Reports JobEnd::done only if the driver executed all.
    JobOutcome run(const Job& job, const Progress& progress, const Listener& listener = {});

    /// From any thread, at once, also entered in the log of a running job.
    void hold();
    void resume();
    void stop();

private:
    Driver& driver_;
    Clock& clock_;
    std::filesystem::path log_folder_;
};

} // namespace millwright::machine
