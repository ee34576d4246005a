// How far a fitted patch and what it was fitted to are apart, both ways.
#pragma once

#include "core/base/progress.h"
#include "core/exchange/internal/fit_target.h"
#include "core/exchange/patch_fit.h"

namespace millwright::exchange {

/// Of a face at points that are spread over it, equally many on equal areas, and at the corners of its
/// triangles, which are on its sides, too: only what its outline leaves, unless that is too little to be met.
/// `trim`: the outline on the patch. `along`: from where the side was seen; nullopt for a whole face. Throws
/// Error for a patch that folds, and for one that goes far away from what it was fitted to; Cancelled.
[[nodiscard]] Deviation deviation_of_fit(const FitTarget& target,
                                         const geometry::BezierPatch& patch,
                                         const geometry::Trim& trim,
                                         const std::optional<Vec3>& along,
                                         bool follows_outline,
                                         int points,
                                         const Progress& progress);

} // namespace millwright::exchange
