#include "core/geometry/surface_point.h"

#include "core/geometry/internal/bernstein.h"
#include "core/geometry/internal/unit_normal.h"

namespace millwright::geometry {

namespace {

/// With first derivatives.
struct Basis {
    Bernstein value, first;
};

void fill(Basis& basis, int n, double t) {
    begin_at_degree(basis.value, n - 1, t);
    differentiate(basis.value, n, basis.first);
    raise_degree(basis.value, n, t);
}

/// Sums over the net in the order of BezierPatch::derivatives, on which the bits depend.
template <class Point> struct Sums { Point s = Point::Zero(), u = Point::Zero(), v = Point::Zero(); };

template <class Point, class PointAt>
Sums<Point> sums(const ControlNet& net, const Basis& bu, const Basis& bv, const PointAt& point_at) {
    Sums<Point> sum;
    std::size_t n = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(net.rows); ++i) {
        Point row = Point::Zero(), row_v = Point::Zero();
        for (std::size_t j = 0; j < static_cast<std::size_t>(net.columns); ++j, ++n) {
            const Point& point = point_at(n);
            row += bv.value[j] * point;
            row_v += bv.first[j] * point;
        }
        sum.s += bu.value[i] * row;
        sum.u += bu.first[i] * row;
        sum.v += bu.value[i] * row_v;
    }
    return sum;
}

Eigen::Vector4d homogeneous(const ControlNet& net, std::size_t n) {
    const double w = net.weights[n];
    const Vec3 weighted = w * net.points[n];
    return {weighted.x(), weighted.y(), weighted.z(), w};
}

} // namespace

SurfacePoint point_of(const BezierPatch& patch, double u, double v) {
    Basis bu, bv;
    fill(bu, patch.degree_u(), u);
    fill(bv, patch.degree_v(), v);
    const ControlNet& net = patch.net();
    const Box3& box = patch.control_box();
    if (!patch.rational()) {
        const auto h = sums<Vec3>(net, bu, bv, [&](std::size_t n) -> const Vec3& { return net.points[n]; });
        return {h.s, unit_normal(box, h.u, h.v)};
    }
    const auto h = sums<Eigen::Vector4d>(net, bu, bv, [&](std::size_t n) { return homogeneous(net, n); });
    const double w = h.s.w(); // S = A / w, and the quotient rule
    const Vec3 position = h.s.head<3>() / w;
    const Vec3 du = (h.u.head<3>() - h.u.w() * position) / w;
    const Vec3 dv = (h.v.head<3>() - h.v.w() * position) / w;
    return {position, unit_normal(box, du, dv)};
}

} // namespace millwright::geometry
