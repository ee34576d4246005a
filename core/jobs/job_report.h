// How far a running job is: what is proven of it, and what is estimated.
#pragma once

#include "core/drivers/driver_status.h"

#include <string>

namespace millwright::jobs {

/// How a running job stands.
struct JobReport {
    drivers::DriverStatus driver;
    int blocks = 0;
    double elapsed = 0.0;      ///< s since the start
    double planned_time = 0.0; ///< of the whole job, s
    bool answers = true;       ///< Capabilities::Reports::execution
    int line = 0; ///< of the listing, where the machine is as far as is known (`driver.block`); 0: not known

    /// How much of it is done, 0 to 1: by the plan, else by the line and how far
    /// it is on that. An estimate.
    [[nodiscard]] double fraction() const;
    /// "37 of 47 blocks executed", or "sent".
    [[nodiscard]] std::string blocks_text() const;
    /// "Block 22 of 47, about line 23, 4 confirmed, 31 sent", or "Block 4 of 47" where nothing is estimated.
    [[nodiscard]] std::string progress_text() const;
};

} // namespace millwright::jobs
