// The order of a carving's cuts, and the path along them.
#pragma once

#include "core/base/progress.h"
#include "core/plot/carving/internal/bit_depth.h"
#include "core/plot/carving/v_carving.h"

#include <vector>

namespace millwright::plot::internal {

/// Passes of one part of the carved area, from above.
using PartPasses = std::vector<std::vector<CutLine>>;

/// From the origin to the nearest part, and on; the passes of each in their order, in each the nearest line
/// next, some backwards. Throws Error for a path that is too long; Cancelled.
[[nodiscard]] CutPath
carving_path(const std::vector<PartPasses>& parts, const CarvingSettings& settings, const Progress& progress);

} // namespace millwright::plot::internal
