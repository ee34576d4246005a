// What the command line reports to a person of a PMAC's protections and of the power of its motors.
#pragma once

#include "core/base/clock.h"
#include "core/pmac/driver/pmac_driver.h"

namespace millwright::app {

/// Which protections the card has off, once it has reported that.
void warn_of_protections(const pmac::PmacDriver& driver, Clock& clock);

/// Drops the link, and tells what became of the motors' power. False if the card did not confirm it: that is
/// told, too.
bool part_from(pmac::PmacDriver& driver);

} // namespace millwright::app
