// Limits along the way, made to hold for a filtered motion too (trajectory.h): a limit of a stretch is
// imposed on the unfiltered motion already before the stretch and still after it.
#pragma once

#include "core/motion/path.h"

namespace millwright::motion::internal {

/// A limit from the end of the zone before up to `end`, and how far beyond both of its ends it holds.
struct Zone {
    double end = 0.0;
    double value = 0.0;
    double reach = 0.0;
    Cause cause;
    bool rests = false; ///< at its end the axes rest: no limit holds across that
};

/// The least of all zones that hold at each place, from `begin` to the end of the last.
[[nodiscard]] Profile profile_of(const std::vector<Zone>& zones, double begin);

} // namespace millwright::motion::internal
