// One straight pass: the way of the tip over a mesh in the plane of a line and the tool's axis, as straight
// moves within a tolerance of the exact way. Frame: the tool's axis is +Z. Lengths mm.
#pragma once

#include "core/mesh_finish/drop_tree.h"

#include <vector>

namespace millwright::mesh_finish {

/// Where a pass is looked for: from `from` in the unit direction `along`.
struct PassLine {
    Vec2 from = Vec2::Zero();
    Vec2 along = Vec2::UnitX();
    double length = 0.0;
};

struct TracedPoint {
    double s = 0.0; ///< along the line
    Drop drop;
};

/// What is traced without an interruption.
using TracedRun = std::vector<TracedPoint>;

/// Points so near each other that a straight move between two that follow each other bites no deeper than
/// half of `tolerance` anywhere into the mesh, whatever lies between them, and rises no more than a quarter
/// of it over the way that was looked at. Runs end where the cutter passes the mesh by, or touches nothing
/// but its border.
[[nodiscard]] std::vector<TracedRun>
traced(const DropTree& tree, const CutterOutline& cutter, const PassLine& line, double tolerance);

/// The points of `run` that are needed: moves between them are within `tolerance` of those that are left out.
[[nodiscard]] TracedRun thinned(const TracedRun& run, double tolerance);

} // namespace millwright::mesh_finish
