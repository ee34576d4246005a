// Patches that share a side are joined: their nets move by the least sum of squares with which they meet
// there, in position (C0) or with the same derivatives across it too (C1).
// Source: Farin, Curves and Surfaces for CAGD, ch. 4.1 (linear conditions between two nets), 6.10 (degree
// elevation).
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_seams.h"

#include <vector>

namespace millwright::geometry {

enum class Continuity {
    position, ///< C0: the two edge rows are one
    tangent   ///< C1: and the rows beside them lie in line with it, in one ratio along the whole seam
};

struct Joined {
    std::vector<BezierPatch> patches; ///< of higher degree where a neighbour along a seam had it
    double largest_move = 0.0;        ///< of a control point, after the degrees were elevated, mm
    double rms_move = 0.0;            ///< of all control points
};

inline constexpr int most_join_conditions = 2'000;

/// Throws Error where a patch is rational, where two patches with `Continuity::tangent` fold back on each
/// other, and for more than `most_join_conditions` conditions.
[[nodiscard]] Joined
joined(const std::vector<BezierPatch>& patches, const std::vector<Seam>& seams, Continuity continuity);

} // namespace millwright::geometry
