#include "core/geometry/surface_point.h"

#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/unit_normal.h"

namespace millwright::geometry {

SurfacePoint point_of(const BezierPatch& patch, double u, double v) {
    const double smallest = patch.smallest_tangent();
    return with_homogeneous_point<1>(patch, u, v, [&](const HomogeneousPoint& h) -> SurfacePoint {
        if (!patch.rational()) {
            return {h.s.head<3>(), unit_normal(smallest, h.u.head<3>(), h.v.head<3>())};
        }
        const double w = h.s.w(); // S = A / w, and the quotient rule
        const Vec3 position = h.s.head<3>() / w;
        const Vec3 du = (h.u.head<3>() - h.u.w() * position) / w;
        const Vec3 dv = (h.v.head<3>() - h.v.w() * position) / w;
        return {position, unit_normal(smallest, du, dv)};
    });
}

} // namespace millwright::geometry
