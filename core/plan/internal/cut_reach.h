// How high over the surface it is looked for what a cutter leaves.
#pragma once

#include "core/toolpath/profile.h"

namespace millwright::plan {

/// mm; what stands higher is taken for not cut. `by_formula`: ScallopFigures::by_formula. Higher than the
/// cutter is wide stands what it never came near: to look as far as the formula says of tracks that are far
/// apart would compare every pose with every point.
[[nodiscard]] double cut_reach(const toolpath::Profile& cutter, double by_formula);

} // namespace millwright::plan
