#include "core/geometry/bezier_patch.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/internal/bernstein.h"
#include "core/geometry/internal/unit_normal.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::geometry {

namespace {

using Vec4 = Eigen::Vector4d;

/// With first and second derivatives.
struct Basis {
    Bernstein value, first, second;
};

/// B_i'' = n (n-1) (B_(i-2) - 2 B_(i-1) + B_i)^(n-2).
Basis basis_at(int n, double t) {
    Basis basis;
    auto& b = basis.value;
    begin_at_degree(b, n - 2, t);
    const auto lower = [&](int i) { return i < 0 || i > n - 2 ? 0.0 : b[static_cast<std::size_t>(i)]; };
    for (int i = 0; i <= n; ++i) {
        basis.second[static_cast<std::size_t>(i)] =
            n < 2 ? 0.0 : n * (n - 1) * (lower(i - 2) - 2.0 * lower(i - 1) + lower(i));
    }
    if (n >= 2) {
        raise_degree(b, n - 1, t);
    }
    differentiate(b, n, basis.first);
    raise_degree(b, n, t);
    return basis;
}

/// The homogeneous surface and its derivatives.
struct Homogeneous {
    Vec4 s = Vec4::Zero(), u = Vec4::Zero(), v = Vec4::Zero();
    Vec4 uu = Vec4::Zero(), uv = Vec4::Zero(), vv = Vec4::Zero();
};

Homogeneous
homogeneous_at(const std::vector<Vec4>& points, int rows, int columns, const Basis& bu, const Basis& bv) {
    Homogeneous sum;
    const Vec4* point = points.data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(rows); ++i) {
        Vec4 row = Vec4::Zero(), row_v = Vec4::Zero(), row_vv = Vec4::Zero();
        for (std::size_t j = 0; j < static_cast<std::size_t>(columns); ++j, ++point) {
            row += bv.value[j] * *point;
            row_v += bv.first[j] * *point;
            row_vv += bv.second[j] * *point;
        }
        sum.s += bu.value[i] * row;
        sum.u += bu.first[i] * row;
        sum.v += bu.value[i] * row_v;
        sum.uu += bu.second[i] * row;
        sum.uv += bu.first[i] * row_v;
        sum.vv += bu.value[i] * row_vv;
    }
    return sum;
}

/// Quotient rule for S = A / w.
SurfaceDerivatives projected(const Homogeneous& h) {
    const double w = h.s.w();
    SurfaceDerivatives at;
    at.position = h.s.head<3>() / w;
    at.du = (h.u.head<3>() - h.u.w() * at.position) / w;
    at.dv = (h.v.head<3>() - h.v.w() * at.position) / w;
    at.duu = (h.uu.head<3>() - 2.0 * h.u.w() * at.du - h.uu.w() * at.position) / w;
    at.duv = (h.uv.head<3>() - h.u.w() * at.dv - h.v.w() * at.du - h.uv.w() * at.position) / w;
    at.dvv = (h.vv.head<3>() - 2.0 * h.v.w() * at.dv - h.vv.w() * at.position) / w;
    return at;
}

std::string fault_at(const ControlNet& net, int i, int j) {
    constexpr double largest_mm = 1e6; // a kilometre; beyond it double precision loses the micrometre
    const Vec3& p = net.point(i, j);
    if (!is_finite(p)) {
        return fmt::format("control point ({},{}) is not finite", i, j);
    }
    if (p.cwiseAbs().maxCoeff() > largest_mm) {
        return fmt::format("control point ({},{}) is farther than {} mm from the origin", i, j, largest_mm);
    }
    const double w = net.weight(i, j);
    constexpr double largest_weight = 1e6;
    if (!(w >= 1.0 / largest_weight && w <= largest_weight)) {
        return fmt::format("weight ({},{}) = {} is not between 1e-6 and 1e6", i, j, w);
    }
    return {};
}

} // namespace

ControlNet ControlNet::sized(int rows, int columns) {
    expects(rows >= 0 && columns >= 0, "a net has no negative size");
    ControlNet net;
    net.rows = rows;
    net.columns = columns;
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    net.points.assign(count, Vec3::Zero());
    net.weights.assign(count, 1.0);
    return net;
}

std::string fault_of(const ControlNet& net) {
    if (net.rows < 2 || net.columns < 2 || net.rows > max_degree + 1 || net.columns > max_degree + 1) {
        return fmt::format("a control net of {} x {} points; 2 to {} each way are possible",
                           net.rows,
                           net.columns,
                           max_degree + 1);
    }
    const auto count = static_cast<std::size_t>(net.rows) * static_cast<std::size_t>(net.columns);
    if (net.points.size() != count || net.weights.size() != count) {
        return fmt::format("a control net of {} x {} has {} points and {} weights",
                           net.rows,
                           net.columns,
                           net.points.size(),
                           net.weights.size());
    }
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            if (std::string fault = fault_at(net, i, j); !fault.empty()) {
                return fault;
            }
        }
    }
    return {};
}

BezierPatch::BezierPatch(ControlNet net) : net_(std::move(net)) {
    if (std::string fault = fault_of(net_); !fault.empty()) {
        throw Error(std::move(fault));
    }
    homogeneous_.reserve(net_.points.size());
    for (std::size_t n = 0; n < net_.points.size(); ++n) {
        const double w = net_.weights[n];
        const Vec3 weighted = w * net_.points[n];
        homogeneous_.emplace_back(weighted.x(), weighted.y(), weighted.z(), w);
        rational_ = rational_ || !exactly_equal(w, 1.0);
        box_.extend(net_.points[n]);
    }
}

Vec3 BezierPatch::position(double u, double v) const {
    return derivatives(u, v).position;
}

SurfaceDerivatives BezierPatch::derivatives(double u, double v) const {
    const Basis bu = basis_at(degree_u(), u);
    const Basis bv = basis_at(degree_v(), v);
    const Homogeneous h = homogeneous_at(homogeneous_, net_.rows, net_.columns, bu, bv);
    if (rational_) {
        return projected(h);
    }
    return {h.s.head<3>(), h.u.head<3>(), h.v.head<3>(), h.uu.head<3>(), h.uv.head<3>(), h.vv.head<3>()};
}

std::optional<Vec3> BezierPatch::unit_normal(double u, double v) const {
    return unit_normal(derivatives(u, v));
}

std::optional<Vec3> BezierPatch::unit_normal(const SurfaceDerivatives& at) const {
    return geometry::unit_normal(box_, at.du, at.dv);
}

} // namespace millwright::geometry
