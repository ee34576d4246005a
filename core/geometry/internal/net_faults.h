// What is wrong with the points and weights of a control net, of a patch or of a B-spline surface.
#pragma once

#include "core/base/numbers.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>

namespace millwright::geometry {

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
