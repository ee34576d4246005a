// The other question about a track: not the least error of so many nodes, but the fewest nodes for an error.
// A shortest path whose edges all have length 1.
#pragma once

#include "core/grid/track.h"
#include "core/grid/track_path.h"

#include <optional>

namespace millwright::grid {

/// Values outside their range throw Defect.
struct FewestNodesSettings {
    int lattice = 2000;         ///< intervals, 8 to 100 000: the fewest nodes are those among its places
    double monitor_share = 0.5; ///< of the lattice's density that follows the error, 0 to 0.99
};

/// The track from `first` to `last` with the fewest nodes whose moves, of any length, are all inside `limits`
/// by fine sampling; of several choices the one with the least sum of length error^2. Nothing if there is
/// none on the lattice, which may be too coarse, or the machine does not reach. Throws Cancelled.
///
/// Not every move is measured finely. A coarser lattice rules out those next to none of whose moves the error
/// is at most four times the limits: on linear axes any part of an allowed move is within twice the limits. A
/// coarse measurement rules out those that exceed the limits by more than a quarter.
[[nodiscard]] std::optional<PlacedTrack> fewest_nodes(const ErrorModel& model,
                                                      const Track& track,
                                                      double first,
                                                      double last,
                                                      const MoveLimits& limits,
                                                      const FewestNodesSettings& settings,
                                                      const Progress& progress);

} // namespace millwright::grid
