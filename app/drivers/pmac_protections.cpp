#include "app/drivers/pmac_protections.h"

#include "core/base/sentences.h"

#include <fmt/format.h>

#include <cstdio>

namespace millwright::app {

void warn_of_protections(const pmac::PmacDriver& driver, Clock& clock) {
    constexpr double glance = 0.005, patience = 2.0; // s
    auto off = driver.protections_off();
    for (double waited = 0.0; !off && waited < patience; waited += glance) {
        clock.wait(glance);
        off = driver.protections_off();
    }
    if (off) {
        for (const std::string& sentence : *off) {
            fmt::print(stderr, "warning: protection off: {}\n", sentence);
        }
    }
}

bool part_from(pmac::PmacDriver& driver) {
    const bool had_power = driver.any_power();
    driver.close();
    if (const std::string farewell = driver.farewell(); !farewell.empty()) {
        fmt::print(stderr, "millwright: {}\n", with_sentence(capitalised(farewell), "Inspect the machine."));
        return false;
    }
    if (driver.any_power()) {
        fmt::print(stderr, "The motors are enabled and no longer supervised.\n");
    } else if (had_power) {
        fmt::print(stderr, "The motors are disabled; --keep-power would leave them enabled.\n");
    }
    return true;
}

} // namespace millwright::app
