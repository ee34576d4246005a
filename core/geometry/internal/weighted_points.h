// Control points with their weights multiplied in, as rational patches and surfaces evaluate them.
#pragma once

#include "core/base/numbers.h"
#include "core/geometry/vectors.h"

#include <cstddef>
#include <span>
#include <vector>

namespace millwright::geometry {

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

} // namespace millwright::geometry
