#include "core/geometry/bezier_patch.h"

#include "core/base/error.h"
#include "core/geometry/internal/control_net.h"
#include "core/geometry/internal/homogeneous_point.h"
#include "core/geometry/internal/unit_normal.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::geometry {

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
    return fault_of_points(net);
}

BezierPatch::BezierPatch(ControlNet net) : net_(std::move(net)) {
    if (std::string fault = fault_of(net_); !fault.empty()) {
        throw Error(std::move(fault));
    }
    WeightedPoints points = weighted(net_.points, net_.weights);
    homogeneous_ = std::move(points.homogeneous);
    rational_ = points.rational;
    box_ = points.box;
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
