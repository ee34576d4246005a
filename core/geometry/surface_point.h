// Where a surface is and which way it faces there, and no more: for searches that ask nothing else, a hundred
// million times.
#pragma once

#include "core/geometry/parametric_surface.h"

#include <optional>

namespace millwright::geometry {

/// The same bits as surface.derivatives(u, v).position and surface.unit_normal(u, v).
[[nodiscard]] inline SurfacePoint point_of(const ParametricSurface& surface, double u, double v) {
    return surface.point(u, v);
}

// How a surface bends at a point.

/// Principal curvatures, 1/mm, positive where the surface bends towards S_u x S_v; k1 >= k2.
struct PrincipalCurvatures {
    double k1 = 0.0;
    double k2 = 0.0;
};

/// From the first and the second fundamental form (Farin, Curves and Surfaces for CAGD, ch. 23). Nothing
/// where the tangents vanish or are parallel.
[[nodiscard]] std::optional<PrincipalCurvatures> principal_curvatures(const SurfaceDerivatives& at);

} // namespace millwright::geometry
