// Work on the nodes of an array or on whole tracks, in parallel.
#pragma once

#include "core/base/parallel.h"
#include "core/base/progress.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>
#include <vector>

namespace millwright::grid {

// Work on all nodes of an array in parallel, in pieces that are worth a thread.

/// As many nodes as are worth handing to another thread: of work that takes some 100 ns per node, and of
/// less.
inline constexpr int nodes_worth_a_thread = 1024;
inline constexpr int light_nodes_worth_a_thread = 8192;

/// Calls `body(i)` for every row i in [0, rows) of `columns` nodes each. An even number of pieces of one
/// size: three of them would keep one of two threads waiting for a third of the time.
template <class Body>
void for_rows(int rows, int columns, const Body& body, int worth_a_thread = nodes_worth_a_thread) {
    const int least = std::max(1, worth_a_thread / std::max(1, columns));
    if (rows <= least) {
        for (int i = 0; i < rows; ++i) {
            body(i);
        }
        return;
    }
    const int pieces = (rows + least - 1) / least;
    const int even = pieces + pieces % 2;
    const std::ptrdiff_t chunk = (rows + even - 1) / even;
    parallel_for(rows, chunk, [&](std::ptrdiff_t i) { body(static_cast<int>(i)); });
}

/// The least `body(i)` of the rows, of work that takes a few ns per node; infinity without rows. NaN must not
/// come.
template <class Body> [[nodiscard]] double least_of_rows(int rows, int columns, const Body& body) {
    std::vector<double> least(static_cast<std::size_t>(rows));
    for_rows(
        rows,
        columns,
        [&](int i) { least[static_cast<std::size_t>(i)] = body(i); },
        light_nodes_worth_a_thread);
    const auto smallest = std::ranges::min_element(least);
    return smallest == least.end() ? std::numeric_limits<double>::infinity() : *smallest;
}

inline constexpr std::size_t nodes_per_piece = 4096;

/// How many pieces for_pieces() makes of `nodes`.
[[nodiscard]] constexpr std::size_t pieces_of(std::size_t nodes) {
    return (nodes + nodes_per_piece - 1) / nodes_per_piece;
}

/// Calls `body(first, count)` for pieces that make up [0, nodes), `first` a multiple of nodes_per_piece.
template <class Body> void for_pieces(std::size_t nodes, const Body& body) {
    const std::size_t pieces = pieces_of(nodes);
    const auto run = [&](std::size_t k) {
        body(k * nodes_per_piece, std::min(nodes_per_piece, nodes - k * nodes_per_piece));
    };
    if (pieces == 1) {
        run(0);
        return;
    }
    parallel_for(
        static_cast<std::ptrdiff_t>(pieces), 1, [&](std::ptrdiff_t k) { run(static_cast<std::size_t>(k)); });
}

// Work on tracks, one after another or side by side.

/// Calls `body` for each track in parallel and tells `progress` how many are done.
template <typename Body> void each_track(std::ptrdiff_t count, const Progress& progress, Body body) {
    std::atomic<int> done = 0;
    parallel_for(count, 1, [&](std::ptrdiff_t t) {
        progress.check();
        body(static_cast<std::size_t>(t));
        progress.report(static_cast<double>(++done) / static_cast<double>(count));
    });
}

} // namespace millwright::grid
