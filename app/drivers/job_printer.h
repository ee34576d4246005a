// What a person reads on the terminal of a job that runs: how far it is, and what it waits for.
#pragma once

#include "app/command_line/watched_work.h"
#include "core/jobs/dispatcher.h"

#include <string>

namespace millwright::app {

class JobPrinter {
public:
    /// `keys`: can be pressed.
    void show(const jobs::JobReport& report, bool keys);
    /// Of what comes before the job.
    void show(const Progress::Report& report) { printer_.show(report); }

private:
    void tell_waiting(const drivers::DriverStatus& now, bool keys);

    ProgressPrinter printer_;
    std::string waits_for_; ///< that was reported; empty: nothing
};

} // namespace millwright::app
