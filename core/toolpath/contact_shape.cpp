#include "core/toolpath/contact_shape.h"

#include "core/base/numbers.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace millwright::toolpath {

namespace {

double inverse(double radius) {
    constexpr double sharpest = 1e9; // 1/mm: of an edge
    return std::isinf(radius) ? 0.0 : radius > 1.0 / sharpest ? 1.0 / radius : sharpest;
}

/// A tangent direction by its components along S_u and S_v.
Vec2 components(const geometry::SurfaceDerivatives& at, const Vec3& along) {
    Eigen::Matrix2d metric;
    metric << at.du.squaredNorm(), at.du.dot(at.dv), at.du.dot(at.dv), at.dv.squaredNorm();
    return metric.fullPivLu().solve(Vec2(along.dot(at.du), along.dot(at.dv)));
}

} // namespace

ContactShape contact_shape(const Profile& body, const Vec3& normal, const Vec3& axis) {
    const ProfileShape& shape = body.shape();
    const Vec3 across = normal.dot(axis) * axis - normal; // from the axis towards the contact
    const double sine = across.norm();
    constexpr double along_axis = 1e-7; // rad, as in Profile::support
    ContactShape found;
    if (sine < along_axis) {
        found.meridian = normal.unitOrthogonal();
        found.parallel = normal.cross(found.meridian);
        const bool flat = shape.flat > 0.0;
        found.meridian_radius = flat ? infinity : shape.corner;
        found.parallel_radius = found.meridian_radius;
        return found;
    }
    found.parallel = axis.cross(across / sine);
    found.meridian = found.parallel.cross(normal);
    constexpr double rounding = 1e-9; // a wall along the flank still touches the corner
    const bool on_corner = normal.dot(axis) >= std::sin(shape.half_angle) - rounding;
    found.meridian_radius = on_corner ? shape.corner : 0.0;
    const double rho = on_corner ? shape.flat + shape.corner * sine : shape.radius;
    found.parallel_radius = rho / sine;
    return found;
}

double least_relative_curvature(const ContactShape& cutter,
                                const geometry::SurfaceDerivatives& at,
                                const Vec3& normal) {
    Eigen::Matrix2d metric;
    metric << at.du.squaredNorm(), at.du.dot(at.dv), at.du.dot(at.dv), at.dv.squaredNorm();
    if (!(metric.determinant() > 1e-12 * square(metric.trace()))) {
        return -infinity;
    }
    Eigen::Matrix2d surface;
    surface << at.duu.dot(normal), at.duv.dot(normal), at.duv.dot(normal), at.dvv.dot(normal);
    const Vec2 m(at.du.dot(cutter.meridian), at.dv.dot(cutter.meridian));
    const Vec2 p(at.du.dot(cutter.parallel), at.dv.dot(cutter.parallel));
    const Eigen::Matrix2d body = inverse(cutter.meridian_radius) * m * m.transpose() +
                                 inverse(cutter.parallel_radius) * p * p.transpose();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> found(
        body - surface, metric, Eigen::EigenvaluesOnly | Eigen::Ax_lBx);
    return found.eigenvalues().minCoeff();
}

double effective_radius(const ContactShape& cutter, const Vec3& normal, const Vec3& feed) {
    const Vec3 across = normal.cross(feed).normalized();
    const double m = square(across.dot(cutter.meridian));
    const double p = square(across.dot(cutter.parallel));
    return (m > 0.0 ? m * cutter.meridian_radius : 0.0) + (p > 0.0 ? p * cutter.parallel_radius : 0.0);
}

double convex_curvature(const geometry::SurfaceDerivatives& at, const Vec3& normal, const Vec3& along) {
    const Vec2 c = components(at, along.normalized());
    const Vec3 bend = c.x() * c.x() * at.duu + 2.0 * c.x() * c.y() * at.duv + c.y() * c.y() * at.dvv;
    return -bend.dot(normal);
}

double scallop_height(double radius, double convex, double gap) {
    return std::max(0.0, gap * gap * (inverse(radius) + convex) / 8.0);
}

double step_over(double radius, double convex, double height) {
    const double relative = inverse(radius) + convex;
    return relative > 0.0 ? std::sqrt(8.0 * height / relative) : infinity;
}

} // namespace millwright::toolpath
