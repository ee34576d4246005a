#include "core/geometry/surface_point.h"

#include "core/base/numbers.h"
#include "core/geometry/bezier_patch.h"
#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/unit_normal.h"

#include <algorithm>
#include <cmath>

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

namespace {

constexpr double parallel = 1e-12; // sine of the angle of the tangents

} // namespace

std::optional<PrincipalCurvatures> principal_curvatures(const SurfaceDerivatives& at) {
    const Vec3 across = at.du.cross(at.dv);
    const double area = across.norm();
    const double scale = at.du.norm() * at.dv.norm();
    if (!(area > parallel * scale)) {
        return std::nullopt;
    }
    const Vec3 normal = across / area;
    const double E = at.du.squaredNorm();
    const double F = at.du.dot(at.dv);
    const double G = at.dv.squaredNorm();
    const double L = at.duu.dot(normal);
    const double M = at.duv.dot(normal);
    const double N = at.dvv.dot(normal);
    const double determinant = area * area; // E G - F^2
    const double mean = (E * N - 2.0 * F * M + G * L) / (2.0 * determinant);
    const double gaussian = (L * N - M * M) / determinant;
    const double half_difference = std::sqrt(std::max(0.0, square(mean) - gaussian));
    return PrincipalCurvatures{mean + half_difference, mean - half_difference};
}

} // namespace millwright::geometry
