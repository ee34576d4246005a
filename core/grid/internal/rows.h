// Work on all rows of an array in parallel, in pieces that are worth a thread.
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

} // namespace millwright::grid
