// A smooth surface over the unit square through the points of a flattened sheet: where the exact faces are to
// be met. Cubic B-spline by least squares with equal spans; source: Piegl and Tiller, The NURBS Book,
// ch. 9.4.
#pragma once

#include "core/region/flattening.h"

#include <span>

namespace millwright::region {

/// `flat` is onto the square. Throws Error where the equations have no solution.
[[nodiscard]] geometry::BsplineSurface
position_map(std::span<const ExactFace> faces, const FaceMesh& mesh, const Flattening& flat);

} // namespace millwright::region
