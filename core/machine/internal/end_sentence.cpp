#include "core/machine/internal/end_sentence.h"

#include "core/base/sentences.h"
#include "core/base/text.h"

#include <fmt/format.h>

namespace millwright::machine::internal {

std::string end_sentence(JobEnd end, const DriverStatus& status, int blocks, double elapsed, int line) {
    const std::string executed = fmt::format("{} of {} blocks were executed for certain in {}{}",
                                             status.executed_blocks,
                                             blocks,
                                             short_time(elapsed),
                                             line > 0 && status.block > status.executed_blocks
                                                 ? fmt::format(", up to about line {}", line)
                                                 : std::string());
    switch (end) {
    case JobEnd::done:
        return fmt::format("All {} blocks were executed in {}.", blocks, short_time(elapsed));
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
