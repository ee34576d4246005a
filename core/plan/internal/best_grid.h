// The best grid of all methods, where the whole chain is asked for.
#pragma once

#include "core/plan/grids.h"

namespace millwright::plan {

/// Smaller is better: largest * mean distance from the surface.
[[nodiscard]] inline double score(const Evaluation& of) {
    return of.closest.max * of.closest.mean;
}

/// As evaluation_by(), and the last link of the chain: see improved_evaluation().
[[nodiscard]] Evaluation best_grid(const GridMaking& by, const Evaluation& uniform, const Progress& progress);

} // namespace millwright::plan
