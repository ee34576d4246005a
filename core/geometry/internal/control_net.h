// Control nets of patches and B-spline surfaces: their points with the weights multiplied in, and what is
// wrong with them.
#pragma once

#include "core/base/numbers.h"
#include "core/geometry/vectors.h"

#include <fmt/format.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace millwright::geometry {

// Control points with their weights multiplied in, as rational patches and surfaces evaluate them.

struct WeightedPoints {
    std::vector<Eigen::Vector4d> homogeneous; ///< (w x, w y, w z, w), mm
    bool rational = false;                    ///< a weight differs from 1
    Box3 box;                                 ///< of the points without their weights
};

/// As many weights as points.
inline WeightedPoints weighted(std::span<const Vec3> points, std::span<const double> weights) {
    WeightedPoints made;
    made.homogeneous.reserve(points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
        const double w = weights[n];
        const Vec3 product = w * points[n];
        made.homogeneous.emplace_back(product.x(), product.y(), product.z(), w);
        made.rational = made.rational || !exactly_equal(w, 1.0);
        made.box.extend(points[n]);
    }
    return made;
}

// What is wrong with the points and weights of a control net, of a patch or of a B-spline surface.

/// Empty if `net` has rows x columns finite points within a kilometre of the origin, and as many weights of
/// 1e-6 to 1e6; beyond a kilometre double precision loses the micrometre. Lengths mm.
template <class Net> std::string fault_of_points(const Net& net) {
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
            const auto& p = net.points[net.index(i, j)];
            if (!is_finite(p)) {
                return fmt::format("control point ({},{}) is not finite", i, j);
            }
            constexpr double largest_mm = 1e6;
            if (p.cwiseAbs().maxCoeff() > largest_mm) {
                return fmt::format(
                    "control point ({},{}) is more than {} mm from the origin", i, j, largest_mm);
            }
            constexpr double largest_weight = 1e6;
            const double w = net.weights[net.index(i, j)];
            if (!(w >= 1.0 / largest_weight && w <= largest_weight)) {
                return fmt::format("weight ({},{}) = {} is not between 1e-6 and 1e6", i, j, w);
            }
        }
    }
    return {};
}

} // namespace millwright::geometry
