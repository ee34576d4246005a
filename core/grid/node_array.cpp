#include "core/grid/node_array.h"

#include "core/base/error.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <array>
#include <limits>

namespace millwright::grid {

namespace {

constexpr double none = -std::numeric_limits<double>::infinity();

void expects_cells(const NodeArray& array) {
    expects(array.rows >= 2 && array.columns >= 2, "an array of nodes with cells is at least 2 x 2");
    expects(std::ssize(array.nodes) == static_cast<std::ptrdiff_t>(array.rows) * array.columns,
            "an array of nodes has rows x columns of them");
}

/// The signed area inside the outline, which is the sum of all cells.
double outline_area(const NodeArray& array) {
    const int last_row = array.rows - 1;
    const int last_column = array.columns - 1;
    const Vec2 origin = array.at(0, 0); // areas far from (0,0) would lose digits
    double doubled = 0.0;
    const auto add = [&](const Vec2& a, const Vec2& b) {
        const Vec2 from = a - origin;
        const Vec2 to = b - origin;
        doubled += cross(from, to);
    };
    for (int i = 0; i < last_row; ++i) {
        add(array.at(i, 0), array.at(i + 1, 0));
        add(array.at(i + 1, last_column), array.at(i, last_column));
    }
    for (int j = 0; j < last_column; ++j) {
        add(array.at(last_row, j), array.at(last_row, j + 1));
        add(array.at(0, j + 1), array.at(0, j));
    }
    return doubled / 2.0;
}

/// The smallest of the four corner triangles of cell (i, j), doubled.
double min_corner(const NodeArray& array, int i, int j) {
    const std::array<Vec2, 4> p{
        array.at(i, j), array.at(i + 1, j), array.at(i + 1, j + 1), array.at(i, j + 1)};
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 ahead = p[(k + 1) % 4] - p[k];
        const Vec2 back = p[(k + 3) % 4] - p[k];
        smallest = std::min(smallest, cross(ahead, back));
    }
    return smallest;
}

} // namespace

bool all_finite(const NodeArray& array) {
    return std::ranges::all_of(array.nodes, [](const Vec2& p) { return is_finite(p); });
}

double min_cell_area(const NodeArray& array) {
    expects_cells(array);
    if (!all_finite(array)) {
        return none;
    }
    return least_of_rows(array.rows - 1, array.columns, [&](int i) {
        double smallest = std::numeric_limits<double>::infinity();
        for (int j = 0; j + 1 < array.columns; ++j) {
            const Vec2 diagonal = array.at(i + 1, j + 1) - array.at(i, j);
            const Vec2 other = array.at(i, j + 1) - array.at(i + 1, j);
            smallest = std::min(smallest, cross(diagonal, other) / 2.0);
        }
        return smallest;
    });
}

double min_corner_jacobian(const NodeArray& array) {
    expects_cells(array);
    if (!all_finite(array)) {
        return none;
    }
    const double smallest = least_of_rows(array.rows - 1, array.columns, [&](int i) {
        double of_row = std::numeric_limits<double>::infinity();
        for (int j = 0; j + 1 < array.columns; ++j) {
            of_row = std::min(of_row, min_corner(array, i, j));
        }
        return of_row;
    });
    const double mean_cell =
        outline_area(array) / (static_cast<double>(array.rows - 1) * static_cast<double>(array.columns - 1));
    return mean_cell > 0.0 ? smallest / mean_cell : none;
}

} // namespace millwright::grid
