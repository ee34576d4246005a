#include "app/drivers/job_printer.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::app {

namespace {

using drivers::DriverState;

} // namespace

void JobPrinter::show(const jobs::JobReport& report, bool keys) {
    const drivers::DriverStatus& now = report.driver;
    const bool holding = now.state == DriverState::holding;
    tell_waiting(now, keys);
    printer_.pause(holding);
    printer_.show({report.fraction(), report.progress_text() + (holding ? ", holding" : "")});
}

/// On a line of its own, whole: a bar has no room for what a person has to do.
void JobPrinter::tell_waiting(const drivers::DriverStatus& now, bool keys) {
    const std::string why = now.state == DriverState::holding
                                ? "holding" + (now.message.empty() ? "" : ": " + now.message)
                                : std::string();
    if (why != std::exchange(waits_for_, why) && !why.empty()) {
        const auto& change = now.tool_change;
        const bool for_tool = change && change->waits && !change->held && !change->keeps_zero;
        const std::string_view goes_on =
            for_tool ? " (r to resume, with the current Z zero)" : " (r to resume)";
        printer_.say(why + (keys ? std::string(goes_on) : ""));
    }
}

} // namespace millwright::app
