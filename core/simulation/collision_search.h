// The first contact of two bodies on a move, or how near they come: distances at a few times, each of which
// clears as much of the move as nothing can get across (conservative advancement). Lengths mm, time as the
// fraction of the move, 0 to 1.
#pragma once

#include "core/simulation/collision_mesh.h"

#include <functional>
#include <optional>

namespace millwright::simulation {

/// Parts of a move in which no point moves farther are not divided: what dips in and out again within one of
/// them by less than this is not seen, and a first contact is as exact along the way.
inline constexpr double search_step = 5e-4; // mm

/// Two bodies on a move.
struct BodyWay {
    /// The nearest place at `t`; nullopt where it is not below `below`. Once a distance is `contact` or less,
    /// less of it does not matter.
    std::function<std::optional<NearPlace>(double t, double below)> nearest;
    /// As RelativeMotion::reach(), and the number of parts that it needs.
    std::function<double(double t, double half)> reach;
    int parts = 1;
    double contact = 0.0;   ///< at this distance and below they meet
    double clearance = 0.0; ///< nearer places are wanted, too; `contact` or above
};

struct Approach {
    double time = 0.0; ///< of the first contact, else of the nearest place
    bool contact = false;
    NearPlace at; ///< without contact its distance may be too large by a quarter
};

/// nullopt where they stay apart by the clearance.
[[nodiscard]] std::optional<Approach> approach(const BodyWay& way);

} // namespace millwright::simulation
