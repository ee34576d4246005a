#include "core/geometry/surface_tangents.h"

#include "core/geometry/internal/bernstein.h"

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

/// Quotient rule for S = A / w.
SurfaceTangents projected(const Sums<Eigen::Vector4d>& h) {
    const double w = h.s.w();
    SurfaceTangents at;
    at.position = h.s.head<3>() / w;
    at.du = (h.u.head<3>() - h.u.w() * at.position) / w;
    at.dv = (h.v.head<3>() - h.v.w() * at.position) / w;
    return at;
}

Eigen::Vector4d homogeneous(const ControlNet& net, std::size_t n) {
    const double w = net.weights[n];
    const Vec3 weighted = w * net.points[n];
    return {weighted.x(), weighted.y(), weighted.z(), w};
}

} // namespace

SurfaceTangents tangents(const BezierPatch& patch, double u, double v) {
    Basis bu, bv;
    fill(bu, patch.degree_u(), u);
    fill(bv, patch.degree_v(), v);
    const ControlNet& net = patch.net();
    if (patch.rational()) {
        return projected(
            sums<Eigen::Vector4d>(net, bu, bv, [&](std::size_t n) { return homogeneous(net, n); }));
    }
    const auto h = sums<Vec3>(net, bu, bv, [&](std::size_t n) -> const Vec3& { return net.points[n]; });
    return {h.s, h.u, h.v};
}

std::optional<Vec3> unit_normal(const BezierPatch& patch, const SurfaceTangents& at) {
    return patch.unit_normal({.position = at.position, .du = at.du, .dv = at.dv});
}

} // namespace millwright::geometry
