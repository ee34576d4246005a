// A face of two spans whose ends are points, as the root of a blade.
#pragma once

#include "core/geometry/bspline_surface.h"

namespace millwright::test {

/// Of degree 2 x 2, 30 x 16 mm, at most 3 mm high: the sides u = 0 and u = 1 are points.
inline geometry::BsplineNet lens_net() {
    geometry::BsplineNet net;
    net.degree_u = 2;
    net.degree_v = 2;
    net.knots_u = {0.0, 0.0, 0.0, 0.4, 1.0, 1.0, 1.0};
    net.knots_v = {0.0, 0.0, 0.0, 1.0, 1.0, 1.0};
    net.rows = 4;
    net.columns = 3;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            const bool tip = i == 0 || i == net.rows - 1;
            net.points.emplace_back(10.0 * i, tip ? 0.0 : 8.0 * (j - 1), tip ? 0.0 : 3.0 - 0.5 * j * j);
            net.weights.push_back(1.0);
        }
    }
    return net;
}

} // namespace millwright::test
