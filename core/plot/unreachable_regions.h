// Parts of a region that a tool does not fit into.
#pragma once

#include "core/plot/compensation.h"

#include <cstddef>

namespace millwright::plot {

/// How many parts of the region (holes, where the tool goes around outside) `compensated` has no path for, as
/// the tool does not fit into them anywhere. Throws Error as `compensated`.
[[nodiscard]] std::size_t count_unreachable_regions(const Region& region,
                                                    const CompensationSettings& settings);

} // namespace millwright::plot
