// Nodes of a grid that is not uniform.
#pragma once

#include "core/grid/grid.h"

#include <random>

namespace millwright::test {

/// A uniform grid, the nodes inside shaken by up to `share` of a cell.
inline grid::NodeArray shaken(int rows, int columns, double share) {
    grid::NodeArray nodes = grid::Grid::uniform(rows, columns).array();
    std::mt19937 random(3);
    std::uniform_real_distribution<double> by(-share, share);
    for (int i = 1; i + 1 < rows; ++i) {
        for (int j = 1; j + 1 < columns; ++j) {
            nodes.at(i, j) += Vec2(by(random) / (rows - 1), by(random) / (columns - 1));
        }
    }
    return nodes;
}

} // namespace millwright::test
