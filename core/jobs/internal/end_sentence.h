// How a job ended, for people.
#pragma once

#include "core/jobs/job.h"

#include <string>

namespace millwright::jobs::internal {

/// "6 of 37 blocks were executed for certain", or "were sent" if the machine does not answer.
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

} // namespace millwright::jobs::internal
