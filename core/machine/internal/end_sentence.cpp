#include "core/machine/internal/end_sentence.h"

#include "core/base/sentences.h"
#include "core/base/text.h"

#include <fmt/format.h>

namespace millwright::machine::internal {

std::string done_text(int executed_blocks, int blocks, bool answers) {
    return fmt::format(
        "{} of {} blocks were {}", executed_blocks, blocks, answers ? "executed for certain" : "sent");
}

std::string
end_sentence(JobEnd end, const DriverStatus& status, const JobOutcome& outcome, int line, bool answers) {
    const std::string time = short_time(outcome.elapsed);
    const std::string executed = done_text(outcome.executed_blocks, outcome.blocks, answers) + " in " + time +
                                 (answers && line > 0 && status.block > outcome.executed_blocks
                                      ? fmt::format(", up to about line {}", line)
                                      : std::string());
    switch (end) {
    case JobEnd::done:
        return answers
                   ? fmt::format("All {} blocks were executed in {}.", outcome.blocks, time)
                   : fmt::format("All {} blocks were sent in {}. The machine gives no answers: whether it "
                                 "executed them is not known.",
                                 outcome.blocks,
                                 time);
    case JobEnd::stopped:
        return fmt::format("The machine was stopped: {}.", executed);
    case JobEnd::cancelled:
        return fmt::format("The job was cancelled: {}.", executed);
    case JobEnd::fault:
        break;
    }
    const std::string why = status.state == DriverState::disconnected ? "the link was lost"
                            : status.message.empty()                  ? "the program did not get to its end"
                                                                      : status.message;
    return with_clause("Fault: " + why, executed + ".");
}

} // namespace millwright::machine::internal
