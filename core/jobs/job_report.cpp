#include "core/jobs/job_report.h"

#include "core/base/counted.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::jobs {

double JobReport::fraction() const {
    if (planned_time > 0.0) {
        return driver.planned_time / planned_time;
    }
    const double done =
        driver.block >= driver.executed_blocks ? driver.block + driver.fraction : driver.executed_blocks;
    return std::clamp(done / std::max(1, blocks), 0.0, 1.0);
}

std::string JobReport::blocks_text() const {
    return fmt::format(
        "{} of {} {}", driver.executed_blocks, counted(blocks, "block"), answers ? "executed" : "sent");
}

std::string JobReport::progress_text() const {
    if (!answers) {
        return fmt::format("Block {} of {} sent", driver.executed_blocks, blocks);
    }
    const std::string sent = driver.sent_blocks > driver.executed_blocks
                                 ? fmt::format(", {} sent", driver.sent_blocks)
                                 : std::string();
    if (line > 0 && driver.block > driver.executed_blocks) {
        return fmt::format("Block {} of {}, about line {}, {} confirmed{}",
                           driver.block,
                           blocks,
                           line,
                           driver.executed_blocks,
                           sent);
    }
    return fmt::format("Block {} of {}{}", driver.executed_blocks, blocks, sent);
}

} // namespace millwright::jobs
