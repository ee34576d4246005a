// The closed outlines among strokes, and what is said of those that are not closed.
#pragma once

#include "core/base/error.h"
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

} // namespace millwright::plot::internal
