// The best places of all nodes of a bent track together: a shortest path through places around each of them,
// which knows of folds, since the tracks on both sides stay. Where a descent follows the slope into the next
// valley, this looks beyond the ridges that branches and singular points make.
#pragma once

#include "core/base/progress.h"
#include "core/grid/path_descent.h"

namespace millwright::grid {

struct CurvedTrackSettings {
    int places_along = 2;  ///< on each side of a node, along its track, 0 to 20
    int places_across = 1; ///< the same across
    double reach = 0.3;    ///< of the furthest of them, in cells of the uniform grid
};

/// `nodes`, first those of the even, then those of the odd tracks where the sum of `objective` over them is
/// least: exactly, among the places. The objective does not rise. Parallel over tracks, same bytes on any
/// number of threads. Throws Cancelled.
[[nodiscard]] NodeArray shortest_curved_tracks(const PathObjective& objective,
                                               NodeArray nodes,
                                               const CurvedTrackSettings& settings,
                                               const Progress& progress);

} // namespace millwright::grid
