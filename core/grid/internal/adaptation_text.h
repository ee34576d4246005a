// The sentences of EllipticAdaptation: what a round has reached, and why a grid was refused.
#pragma once

#include "core/grid/grid_optimiser.h"

#include <string>
#include <vector>

namespace millwright::grid {

/// Why a solver failed, as the rest of a sentence.
[[nodiscard]] std::string failure_sentence(SolverStatus status);

[[nodiscard]] std::string mean_sentence(const ErrorSummary& error);

[[nodiscard]] std::string iteration_sentence(const OptimiserState& state);

/// That the solver did not converge in the round that has just ended.
/// `iterations`: of the round, without those before a restart.
[[nodiscard]] std::string unsolved_sentence(const OptimiserState& state, int iterations, double tolerance);

/// Of the refused grids those with a lower mean than the one that was taken: how good they were, and why not.
/// `too_wide` and `worse_elsewhere` are their means, mm.
[[nodiscard]] std::string refusals(const std::vector<double>& too_wide,
                                   const std::vector<double>& worse_elsewhere,
                                   double taken,
                                   double gap_allowance);

} // namespace millwright::grid
