#include "core/geometry/curvature.h"

#include "core/base/numbers.h"

#include <algorithm>
#include <cmath>

namespace millwright::geometry {

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
