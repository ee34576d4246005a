// Which parts of a pass are cut where it is not needed as a whole: a pass across the others on steep places,
// a pass between two others where the way dips between them. Lengths mm.
#pragma once

#include "core/mesh_finish/pass_tracing.h"

#include <vector>

namespace millwright::mesh_finish {

/// Where passes along X leave more than passes along Y would: their gap grows with the slope across.
[[nodiscard]] std::vector<bool> steep_across_x(const TracedRun& run);

/// Where the way over `line` is lower than the mean of the ways `gap` to both sides by more than `dip`, or
/// one of them meets no mesh.
[[nodiscard]] std::vector<bool> dips_between(const DropTree& tree,
                                             const CutterOutline& cutter,
                                             const PassLine& line,
                                             const TracedRun& run,
                                             double gap,
                                             double dip);

/// The parts that are needed, with what lies within `spare` of them along the run, and with what is shorter
/// than `link` between two of them.
[[nodiscard]] std::vector<TracedRun>
parts_of(const TracedRun& run, const std::vector<bool>& needed, double spare, double link);

} // namespace millwright::mesh_finish
