// Arrays of nodes that tests of grids start from.
#pragma once

#include "core/base/units.h"
#include "core/grid/node_array.h"

#include <cmath>

namespace millwright::grid {

/// x = i, y = j, spacing 1: the start of the regression runs.
[[nodiscard]] inline NodeArray unit_spaced(int rows, int columns) {
    NodeArray array(rows, columns);
    for (int i = 0; i < rows; ++i) {
        for (int j = 0; j < columns; ++j) {
            array.at(i, j) = Vec2(i, j);
        }
    }
    return array;
}

[[nodiscard]] inline NodeArray square_grid(int n) {
    return unit_spaced(n, n);
}

/// The start of the smoothing run: square_grid(n) with its interior displaced by sines.
[[nodiscard]] inline NodeArray displaced_square_grid(int n, double amount) {
    NodeArray array = square_grid(n);
    for (int i = 1; i + 1 < n; ++i) {
        for (int j = 1; j + 1 < n; ++j) {
            const double s = pi * i / (n - 1);
            const double t = 2.0 * pi * j / (n - 1);
            array.at(i, j) += amount * Vec2(std::sin(2.0 * s) * std::sin(t), std::sin(s) * std::sin(t));
        }
    }
    return array;
}

} // namespace millwright::grid
