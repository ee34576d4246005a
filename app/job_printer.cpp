#include "app/job_printer.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::app {

namespace {

using machine::DriverState;

double fraction_of(const machine::JobReport& report) {
    return report.planned_time > 0.0 ? report.driver.planned_time / report.planned_time
                                     : static_cast<double>(report.driver.executed_blocks) / report.blocks;
}

} // namespace

void JobPrinter::show(const machine::JobReport& report, bool keys) {
    const machine::DriverStatus& now = report.driver;
    const bool holding = now.state == DriverState::holding;
    tell_waiting(now, keys);
    printer_.pause(holding);
    printer_.show(
        {fraction_of(report),
         fmt::format("Block {} of {}{}", now.executed_blocks, report.blocks, holding ? ", holding" : "")});
}

/// On a line of its own, whole: a bar has no room for what a person has to do.
void JobPrinter::tell_waiting(const machine::DriverStatus& now, bool keys) {
    const std::string why = now.state == DriverState::holding
                                ? "holding" + (now.message.empty() ? "" : ": " + now.message)
                                : std::string();
    if (why != std::exchange(waits_for_, why) && !why.empty()) {
        printer_.say(why + (keys ? " (r goes on)" : ""));
    }
}

} // namespace millwright::app
