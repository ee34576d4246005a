// The best grid of all methods, where the whole chain is asked for.
#pragma once

#include "core/project/grids.h"

namespace millwright::project {

/// As evaluation_by(), and the last link of the chain: see improved_evaluation().
[[nodiscard]] Evaluation best_grid(const GridMaking& by, const Evaluation& uniform, const Progress& progress);

} // namespace millwright::project
