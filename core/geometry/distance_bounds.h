// Between which figures the distance of a point from a surface surely lies: a proof of what a search found.
// Source: branch and bound over parts of the surface, each inside the convex hull of its control points
// (Farin, Curves and Surfaces for CAGD, ch. 4.3).
#pragma once

#include "core/geometry/parametric_surface.h"

namespace millwright::geometry {

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
