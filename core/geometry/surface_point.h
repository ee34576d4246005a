// Where a surface is and which way it faces there, and no more: for searches that ask nothing else, a hundred
// million times.
#pragma once

#include "core/geometry/parametric_surface.h"

namespace millwright::geometry {

/// The same bits as surface.derivatives(u, v).position and surface.unit_normal(u, v).
[[nodiscard]] inline SurfacePoint point_of(const ParametricSurface& surface, double u, double v) {
    return surface.point(u, v);
}

} // namespace millwright::geometry
