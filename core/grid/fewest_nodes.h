// The other way round: not the least error of so many nodes, but the fewest nodes within a tolerance.
#pragma once

#include "core/grid/move_cost.h"
#include "core/grid/track.h"

#include <optional>

namespace millwright::grid {

/// Values outside their range throw Defect.
struct FewestNodesSettings {
    int lattice = 2000;         ///< intervals, 8 to 100 000: the fewest nodes are those among its places
    double monitor_share = 0.5; ///< of the lattice's density that follows the error, 0 to 0.99
};

/// The track from `first` to `last` with the fewest nodes whose moves are all inside `limits` by fine
/// sampling; of several choices the one with the least sum of length error^2. Moves of any length count.
/// Nothing if there is none on the lattice, which may be too coarse, or the machine does not reach. A lattice
/// of a quarter of the places tells which moves are worth measuring: those next to one of its moves whose
/// error is inside of four times as much. Throws Cancelled.
[[nodiscard]] std::optional<PlacedTrack> fewest_nodes(const ErrorModel& model,
                                                      const Track& track,
                                                      double first,
                                                      double last,
                                                      const MoveLimits& limits,
                                                      const FewestNodesSettings& settings,
                                                      const Progress& progress);

} // namespace millwright::grid
