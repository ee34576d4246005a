#include "core/geometry/bezier_patch.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/projected.h"
#include "core/geometry/internal/unit_normal.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::geometry {

namespace {

std::string fault_at(const ControlNet& net, int i, int j) {
    constexpr double largest_mm = 1e6; // a kilometre; beyond it double precision loses the micrometre
    const Vec3& p = net.point(i, j);
    if (!is_finite(p)) {
        return fmt::format("control point ({},{}) is not finite", i, j);
    }
    if (p.cwiseAbs().maxCoeff() > largest_mm) {
        return fmt::format("control point ({},{}) is more than {} mm from the origin", i, j, largest_mm);
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
        return fmt::format("a control net of {} x {} points is not possible: use 2 to {} in each direction",
                           net.rows,
                           net.columns,
                           max_degree + 1);
    }
    const auto count = static_cast<std::size_t>(net.rows) * static_cast<std::size_t>(net.columns);
    if (net.points.size() != count || net.weights.size() != count) {
        return fmt::format("a control net of {} x {} does not match {} points and {} weights",
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
    smallest_tangent_ = geometry::smallest_tangent(box_);
}

Vec3 BezierPatch::position(double u, double v) const {
    return with_homogeneous_point<0>(*this, u, v, [&](const HomogeneousPoint& h) -> Vec3 {
        return rational_ ? Vec3(h.s.head<3>() / h.s.w()) : Vec3(h.s.head<3>());
    });
}

SurfaceDerivatives BezierPatch::derivatives(double u, double v) const {
    if (rational_) {
        return with_homogeneous_point<2>(*this, u, v, projected);
    }
    return with_homogeneous_point<2>(*this, u, v, [](const HomogeneousPoint& h) -> SurfaceDerivatives {
        return {h.s.head<3>(), h.u.head<3>(), h.v.head<3>(), h.uu.head<3>(), h.uv.head<3>(), h.vv.head<3>()};
    });
}

std::vector<SurfacePiece> BezierPatch::pieces() const {
    return {SurfacePiece{*this}};
}

std::shared_ptr<const ParametricSurface> BezierPatch::shared() const {
    return std::make_shared<const BezierPatch>(*this);
}

} // namespace millwright::geometry
