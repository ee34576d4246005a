#include "core/geometry/bezier_patch.h"
#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/unit_normal.h"

namespace millwright::geometry {

SurfacePoint BezierPatch::point(double u, double v) const {
    const double smallest = smallest_tangent_;
    return with_homogeneous_point<1>(*this, u, v, [&](const HomogeneousPoint& h) -> SurfacePoint {
        if (!rational_) {
            return {h.s.head<3>(), geometry::unit_normal(smallest, h.u.head<3>(), h.v.head<3>())};
        }
        const double w = h.s.w(); // S = A / w, and the quotient rule
        const Vec3 position = h.s.head<3>() / w;
        const Vec3 du = (h.u.head<3>() - h.u.w() * position) / w;
        const Vec3 dv = (h.v.head<3>() - h.v.w() * position) / w;
        return {position, geometry::unit_normal(smallest, du, dv)};
    });
}

} // namespace millwright::geometry
