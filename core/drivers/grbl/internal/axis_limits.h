// What a controller's settings say of its axes' limits, and of how it is set up.
#pragma once

#include "core/drivers/driver.h"

#include <string>
#include <vector>

namespace millwright::drivers::grbl {

struct Readout;

/// As Driver::limits(). Nothing of an axis is there that the controller has not reported.
[[nodiscard]] MachineLimits machine_limits(const Readout& readout);
/// As Driver::remarks().
[[nodiscard]] std::vector<std::string> setup_remarks(const Readout& readout);

} // namespace millwright::drivers::grbl
