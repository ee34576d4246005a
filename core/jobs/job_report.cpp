#include "core/jobs/job_report.h"

#include "core/base/counted.h"
#include "core/base/sentences.h"
#include "core/base/text.h"

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

std::string done_text(int executed_blocks, int blocks, bool answers) {
    return fmt::format("{} of {} {} {}",
                       executed_blocks,
                       counted(blocks, "block"),
                       executed_blocks == 1 ? "was" : "were",
                       answers ? "confirmed as executed" : "sent");
}

std::string all_blocks_text(int blocks) {
    return blocks == 1 ? "the only block was" : fmt::format("all {} blocks were", blocks);
}

std::string end_sentence(
    JobEnd end, const drivers::DriverStatus& status, const JobOutcome& outcome, int line, bool answers) {
    const std::string time = short_time(outcome.elapsed);
    const std::string executed = done_text(outcome.executed_blocks, outcome.blocks, answers) + " in " + time +
                                 (answers && line > 0 && status.block > outcome.executed_blocks
                                      ? fmt::format(", up to about line {}", line)
                                      : std::string());
    switch (end) {
    case JobEnd::done:
        return capitalised(all_blocks_text(outcome.blocks)) +
               (answers ? fmt::format(" executed in {}.", time)
                        : fmt::format(" sent in {}. The machine sends no replies, so it is not known whether "
                                      "it executed {}.",
                                      time,
                                      outcome.blocks == 1 ? "it" : "them"));
    case JobEnd::stopped:
        return fmt::format("The machine was stopped: {}.", executed);
    case JobEnd::cancelled:
        return fmt::format("The job was cancelled: {}.", executed);
    case JobEnd::fault:
        break;
    }
    const std::string why = status.state == drivers::DriverState::disconnected ? "the link was lost"
                            : status.message.empty()                           ? "the program did not finish"
                                                                               : status.message;
    return with_clause("Fault: " + why, executed + ".");
}

std::string log_lost_sentence(const drivers::DriverStatus& status, int blocks, const std::string& why) {
    if (status.executed_blocks == blocks) {
        return "the job finished, but " + why;
    }
    const int at = std::min(std::max(status.executed_blocks, status.block) + 1, blocks);
    return status.state == drivers::DriverState::disconnected
               ? fmt::format("the link was lost at block {} of {} while the job was being stopped because {}",
                             at,
                             blocks,
                             why)
               : fmt::format("the job was stopped at block {} of {} because {}", at, blocks, why);
}

} // namespace millwright::jobs
