// How far a carving's path cuts beyond the outlines of its region. Lengths mm.
#pragma once

#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot_strokes/region.h"

namespace millwright::plot::internal {

/// The largest distance by which the bit, as wide as at the top of the work, passes an outline of `region`,
/// at four places of each move below z = 0; outside of the region the way back to it counts as well. Below 0
/// where the bit stays clear of every outline; 0 where nothing is cut. Throws Cancelled.
[[nodiscard]] double path_deviation(const CutPath& path,
                                    const Region& region,
                                    const ToolTip& tip,
                                    const Progress& progress = Progress());

} // namespace millwright::plot::internal
