// Bounds of a surface that are proven and not sampled: how far it goes in a direction, and how far a point is
// from it.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/parametric_surface.h"

namespace millwright::geometry {

// The point of a patch that lies farthest in a direction: where the box of the patch itself ends, which that
// of its control points only holds.

struct FarthestPoint {
    Vec2 parameters = Vec2::Zero(); ///< in [0,1]^2
    double along = 0.0;             ///< position . direction
};

/// To within a thousand-millionth of the extent of the control points in that direction.
[[nodiscard]] FarthestPoint farthest_point(const BezierPatch& patch, const Vec3& direction);

// Between which figures the distance of a point from a surface surely lies: a proof of what a search found.
// Source: branch and bound over parts of the surface, each inside the convex hull of its control points
// (Farin, Curves and Surfaces for CAGD, ch. 4.3).

struct DistanceBounds {
    double at_least = 0.0; ///< mm
    double at_most = 0.0;  ///< mm
};

/// `found` is the distance of `point` from some place of the surface, mm. Ends as soon as the bounds are
/// closer than `tolerance` (mm, above 0), or after `most_splits` parts of it were split, whatever they are
/// then. Throws Defect if a number is not finite or the tolerance not positive.
[[nodiscard]] DistanceBounds distance_bounds(const ParametricSurface& surface,
                                             const Vec3& point,
                                             double found,
                                             double tolerance,
                                             int most_splits = 4000);

} // namespace millwright::geometry
