// How sure the largest error of a path is.
#pragma once

#include "core/geometry/surface_bounds.h"
#include "core/plan/evaluation.h"

#include <optional>

namespace millwright::plan {

/// Between which figures the largest `closest` of the moves inside tracks surely lies, mm. At least: how far
/// the tip is off at the place where it was found. At most: what was found, since no move is farther off than
/// the point of the surface that was found for it. Nothing with a cutter, whose error is no distance of its
/// tip, or without a move inside a track.
[[nodiscard]] std::optional<geometry::DistanceBounds> largest_error_bounds(const CuttingSetup& cutting_setup,
                                                                           const Evaluation& evaluation);

} // namespace millwright::plan
