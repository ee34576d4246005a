#include "core/grid/internal/outline.h"

#include "core/base/numbers.h"

#include <algorithm>

namespace millwright::grid {

bool is_axis_rectangle(const NodeArray& nodes) {
    const int last_row = nodes.rows - 1;
    const int last_column = nodes.columns - 1;
    bool straight = true;
    for (int j = 0; j < nodes.columns; ++j) {
        straight = straight && exactly_equal(nodes.at(0, j).x(), nodes.at(0, 0).x()) &&
                   exactly_equal(nodes.at(last_row, j).x(), nodes.at(last_row, 0).x());
    }
    for (int i = 0; i < nodes.rows; ++i) {
        straight = straight && exactly_equal(nodes.at(i, 0).y(), nodes.at(0, 0).y()) &&
                   exactly_equal(nodes.at(i, last_column).y(), nodes.at(0, last_column).y());
    }
    return straight;
}

NodeArray with_mirrored_ring(const NodeArray& nodes) {
    const Vec2 low = nodes.at(0, 0);
    const Vec2 high = nodes.at(nodes.rows - 1, nodes.columns - 1);
    NodeArray wider(nodes.rows + 2, nodes.columns + 2);
    for (int i = -1; i <= nodes.rows; ++i) {
        for (int j = -1; j <= nodes.columns; ++j) {
            Vec2 p = nodes.at(mirrored_index(i, nodes.rows), mirrored_index(j, nodes.columns));
            if (i < 0 || i == nodes.rows) {
                p.x() = 2.0 * (i < 0 ? low.x() : high.x()) - p.x();
            }
            if (j < 0 || j == nodes.columns) {
                p.y() = 2.0 * (j < 0 ? low.y() : high.y()) - p.y();
            }
            wider.at(i + 1, j + 1) = p;
        }
    }
    return wider;
}

std::vector<double> with_mirrored_ring(const std::vector<double>& values, int rows, int columns) {
    std::vector<double> wider;
    wider.reserve((static_cast<std::size_t>(rows) + 2) * (static_cast<std::size_t>(columns) + 2));
    for (int i = -1; i <= rows; ++i) {
        for (int j = -1; j <= columns; ++j) {
            const auto index =
                static_cast<std::size_t>(mirrored_index(i, rows)) * static_cast<std::size_t>(columns) +
                static_cast<std::size_t>(mirrored_index(j, columns));
            wider.push_back(values[index]);
        }
    }
    return wider;
}

} // namespace millwright::grid
