// The closed outlines among strokes, and what is said of those that are not closed.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"
#include "core/plot/cut_path.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot_strokes/region.h"
#include "core/plot_strokes/strokes.h"

#include <vector>

namespace millwright::plot::internal {

struct CarvingOutlines {
    Region region;
    std::vector<Diagnostic> notices; ///< on open strokes
};

/// Ends no farther apart than `gap` mm are joined. Throws Error where nothing is closed.
[[nodiscard]] CarvingOutlines carving_outlines(const Strokes& drawn, double gap);

// How far a carving's path cuts beyond the outlines of its region. Lengths mm.

/// The largest distance by which the bit, as wide as at the top of the work, passes an outline of `region`,
/// at four places of each move below z = 0; outside of the region the way back to it counts as well. Below 0
/// where the bit stays clear of every outline; 0 where nothing is cut. Throws Cancelled.
[[nodiscard]] double path_deviation(const CutPath& path,
                                    const Region& region,
                                    const ToolTip& tip,
                                    const Progress& progress = Progress());

} // namespace millwright::plot::internal
