// A rectangular array of points of a plane, on its way to being a Grid or after having stopped being one: the
// elliptic solver works on it, and it may fold. Row i runs along the first grid direction, as x_ij in the
// papers.
#pragma once

#include "core/geometry/vectors.h"

#include <vector>

namespace millwright::grid {

struct NodeArray {
    int rows = 0;            ///< nodes along the first direction (xi; u)
    int columns = 0;         ///< nodes along the second direction (eta; v)
    std::vector<Vec2> nodes; ///< [rows x columns], row-major

    NodeArray() = default;
    NodeArray(int rows_, int columns_)
        : rows(rows_), columns(columns_),
          nodes(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_), Vec2::Zero()) {}

    [[nodiscard]] Vec2& at(int i, int j) { return nodes[index(i, j)]; }
    [[nodiscard]] const Vec2& at(int i, int j) const { return nodes[index(i, j)]; }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(i) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(j);
    }

    friend bool operator==(const NodeArray&, const NodeArray&) = default;
};

/// Every node finite.
[[nodiscard]] bool all_finite(const NodeArray& array);

/// The smallest cell, as half the cross product of its diagonals. Positive cells turn from row to column.
[[nodiscard]] double min_cell_area(const NodeArray& array);

/// The smallest of the four corner triangles of any cell, doubled and divided by the mean cell area of the
/// array's outline: 1 on a uniform grid, not positive where a cell folds.
[[nodiscard]] double min_corner_jacobian(const NodeArray& array);

} // namespace millwright::grid
