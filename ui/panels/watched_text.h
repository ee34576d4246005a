// What the Grid workspace says of an adaptation that is watched: figures of a running one are not its last.
#pragma once

#include "core/grid/grid_optimiser.h"

#include <string>
#include <string_view>

namespace millwright::panels {

struct WatchedLabels {
    std::string_view best;   ///< of the mean error of the best grid
    std::string_view change; ///< of how far that is below the start
    std::string_view axis;   ///< of the largest axis deviation, from the start to the best grid
};

[[nodiscard]] WatchedLabels watched_labels(grid::OptimiserStatus status);

/// Why the figures at the end can be other than those so far, and why a grid with less error is not kept;
/// empty where there is nothing to say.
[[nodiscard]] std::string watched_note(const grid::OptimiserState& state);

} // namespace millwright::panels
