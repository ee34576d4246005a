// Work on all nodes of an array in parallel, in pieces that are worth a thread.
#pragma once

#include "core/base/parallel.h"

#include <algorithm>
#include <cstddef>

namespace millwright::grid {

/// Calls `body(i)` for every row i in [0, rows) of `columns` nodes each.
template <class Body> void for_rows(int rows, int columns, const Body& body) {
    constexpr int nodes_worth_a_thread = 1024;
    const std::ptrdiff_t chunk = std::max(1, nodes_worth_a_thread / std::max(1, columns));
    if (rows <= chunk) {
        for (int i = 0; i < rows; ++i) {
            body(i);
        }
        return;
    }
    parallel_for(rows, chunk, [&](std::ptrdiff_t i) { body(static_cast<int>(i)); });
}

/// Calls `body(first, count)` for pieces that make up [0, nodes).
template <class Body> void for_pieces(std::size_t nodes, const Body& body) {
    constexpr std::size_t piece = 1024;
    const std::size_t pieces = (nodes + piece - 1) / piece;
    const auto run = [&](std::size_t k) { body(k * piece, std::min(piece, nodes - k * piece)); };
    if (pieces == 1) {
        run(0);
        return;
    }
    parallel_for(
        static_cast<std::ptrdiff_t>(pieces), 1, [&](std::ptrdiff_t k) { run(static_cast<std::size_t>(k)); });
}

} // namespace millwright::grid
