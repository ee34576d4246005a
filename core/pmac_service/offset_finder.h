// The output at which a motor stands still (Ix29): the middle between the two values at which it begins to
// creep, one way and the other (Saengsasri, Nittayachin 1996, KMITL, conclusion). The gain is 0 meanwhile, so
// that nothing but the offset moves the motor, and each try ends as soon as its direction is seen.
#pragma once

#include "core/pmac_service/card_talk.h"

#include <optional>

namespace millwright::pmac {

struct OffsetSearch {
    std::optional<int> from{}; ///< bits to begin with; nothing: Ix29
    double creep = 20.0;       ///< counts after which a direction is seen, > 0
    double look = 0.5;         ///< s after which a motor stands still, > 0
    double glance = 0.005;     ///< s between two looks, > 0
    double most_way =
        10000.0; ///< counts from where it began, with what it coasts, beyond which the search is given up
};

struct OffsetFound {
    int before = 0;   ///< Ix29 as it was
    int backward = 0; ///< the highest at which it creeps back
    int forward = 0;  ///< the lowest at which it creeps forward
    int middle = 0;
    double farthest = 0.0; ///< counts from where it began
};

/// Leaves the motor without power, and all variables as they were. Throws Error if it does not move either
/// way within Ix69, or goes too far; also then the motor has no power.
[[nodiscard]] OffsetFound find_offset(const CardTalk& card, int motor, const OffsetSearch& search = {});

} // namespace millwright::pmac
