// How far a running job is: what is proven of it, and what is estimated.
#pragma once

#include "core/drivers/driver_status.h"
#include "core/jobs/job.h"

#include <string>

namespace millwright::jobs {

/// How a running job stands.
struct JobReport {
    drivers::DriverStatus driver;
    int blocks = 0;
    double elapsed = 0.0;      ///< s since the start
    double planned_time = 0.0; ///< of the whole job, s
    bool answers = true;       ///< Capabilities::Reports::execution
    int line = 0; ///< of the listing, where the machine is as far as is known (`driver.block`); 0: not known

    /// How much of it is done, 0 to 1: by the plan, else by the line and how far
    /// it is on that. An estimate.
    [[nodiscard]] double fraction() const;
    /// "37 of 47 blocks executed", or "sent".
    [[nodiscard]] std::string blocks_text() const;
    /// "Block 22 of 47, about line 23, 4 confirmed, 31 sent", or "Block 4 of 47" where nothing is estimated.
    [[nodiscard]] std::string progress_text() const;
};

// How a job ended, for people.

/// "6 of 37 blocks were confirmed as executed", or "were sent" if the machine does not answer.
[[nodiscard]] std::string done_text(int executed_blocks, int blocks, bool answers);

/// "all 37 blocks were", or "the only block was".
[[nodiscard]] std::string all_blocks_text(int blocks);

/// Of an outcome that has no sentence yet. `line`: where the machine was as far as is known, 0: not known;
/// `answers`: Capabilities::Reports::execution.
[[nodiscard]] std::string end_sentence(
    JobEnd end, const drivers::DriverStatus& status, const JobOutcome& outcome, int line, bool answers);

/// Of a job that was stopped at `status` because of `why`, a clause: "the job was stopped at block 7 of 63,
/// since ...".
[[nodiscard]] std::string
log_lost_sentence(const drivers::DriverStatus& status, int blocks, const std::string& why);

} // namespace millwright::jobs
