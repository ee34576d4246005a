#include "core/geometry/parametric_surface.h"

#include "core/geometry/internal/unit_normal.h"

namespace millwright::geometry {

std::optional<Vec3> ParametricSurface::unit_normal(const SurfaceDerivatives& at) const {
    return geometry::unit_normal(smallest_tangent(), at.du, at.dv);
}

} // namespace millwright::geometry
