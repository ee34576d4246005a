// The grid on which a prototype of the chain was measured.
#pragma once

#include "core/grid/grid.h"
#include "core/grid/node_array.h"

namespace millwright::test {

/// 20 tracks, v = 0.02 ... 0.98.
inline grid::Grid inner_tracks(int nodes) {
    constexpr int tracks = 20;
    grid::NodeArray array(nodes, tracks);
    for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < tracks; ++j) {
            array.at(i, j) = {static_cast<double>(i) / (nodes - 1), 0.02 + 0.96 * j / (tracks - 1)};
        }
    }
    return grid::Grid(array);
}

} // namespace millwright::test
