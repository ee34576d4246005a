// Functionals over the corners of the cells of a grid, and what they have in common.
#pragma once

#include "core/base/numbers.h"
#include "core/grid/elliptic_equations.h"
#include "core/grid/grid.h"
#include "core/grid/internal/parallel_nodes.h"
#include "core/grid/node_array.h"
#include "core/grid/weight.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace millwright::grid {

// The grid functional I_s + 2 LV I_v + LO I_o on the grid itself instead of its Euler equations: a quarter of
// the sum over the four corner triangles of every cell (after Ivanenko 1993). Its smoothness term grows
// without bound as a triangle closes, so that a descent which starts without a fold never makes one.

struct DiscreteFunctional {
    double value = 0.0; ///< infinity if a corner triangle is not positive or the weight is not finite
    NodeArray gradient; ///< d value / d node, about -2 (R_X, R_Y) inside; empty if the value is infinite
};

/// Parallel over rows, same bytes on any number of threads. Throws Error if the weight does.
[[nodiscard]] DiscreteFunctional
discrete_functional(const NodeArray& nodes, const Weight& weight, const FunctionalWeights& lambda);

} // namespace millwright::grid

namespace millwright::grid::internal {

// What functionals over the corners of the cells of a grid have in common: a quarter of the sum over the four
// corner triangles of every cell, and its gradient at the nodes. Same bytes on any number of threads.

inline constexpr double infinite = std::numeric_limits<double>::infinity();

/// Value of one corner and how it changes. An infinite value stands for a corner that is not positive.
struct CornerTerm {
    double value = 0.0;
    Vec2 by_xi = Vec2::Zero();  ///< d value / d edge along the first direction
    Vec2 by_eta = Vec2::Zero(); ///< ... along the second
    double by_weight = 0.0;     ///< d value / d weight at the corner's node
};

struct CornerEdges {
    Vec2 xi, eta;
    double J; ///< their cross product, positive
};

/// Nodes of a cell: 0 at (i, j), 1 at (i+1, j), 2 at (i+1, j+1), 3 at (i, j+1).
struct Corner {
    std::size_t at;               ///< the node whose weight counts
    std::size_t xi_from, xi_to;   ///< the edge along the first direction
    std::size_t eta_from, eta_to; ///< the edge along the second
};
inline constexpr std::array<Corner, 4> corners{
    {{0, 0, 1, 0, 3}, {1, 0, 1, 1, 2}, {2, 3, 2, 1, 2}, {3, 3, 2, 0, 3}}};

struct NodalWeight {
    std::vector<double> w;
    std::vector<Vec2> slope;
    bool finite = false;
};

[[nodiscard]] inline NodalWeight nodal_weight(const NodeArray& nodes, const Weight& weight) {
    NodalWeight found{weight_at_nodes(weight, nodes), std::vector<Vec2>(nodes.nodes.size()), false};
    for_pieces(found.slope.size(), [&](std::size_t first, std::size_t count) {
        weight.gradients(std::span(nodes.nodes).subspan(first, count),
                         std::span(found.slope).subspan(first, count));
    });
    found.finite = std::ranges::all_of(found.w, [](double w) { return std::isfinite(w); }) &&
                   std::ranges::all_of(found.slope, [](const Vec2& s) { return is_finite(s); });
    return found;
}

struct CellTerms {
    double value = 0.0;
    std::array<Vec2, 4> gradient{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

template <class Term>
CellTerms cell_terms(const NodeArray& nodes, const NodalWeight& weight, const Term& term, int i, int j) {
    constexpr double share = 0.25; // of one corner in its cell
    const std::array<std::size_t, 4> index{
        nodes.index(i, j), nodes.index(i + 1, j), nodes.index(i + 1, j + 1), nodes.index(i, j + 1)};
    CellTerms cell;
    for (const Corner& corner : corners) {
        const auto edge = [&](std::size_t from, std::size_t to) -> Vec2 {
            return nodes.nodes[index[to]] - nodes.nodes[index[from]];
        };
        CornerEdges edges{edge(corner.xi_from, corner.xi_to), edge(corner.eta_from, corner.eta_to), 0.0};
        edges.J = edges.xi.x() * edges.eta.y() - edges.eta.x() * edges.xi.y();
        if (!(edges.J > 0.0)) {
            cell.value = infinite;
            return cell;
        }
        const std::size_t at = index[corner.at];
        const CornerTerm found = term(edges, weight.w[at]);
        cell.value += share * found.value;
        cell.gradient[corner.xi_to] += share * found.by_xi;
        cell.gradient[corner.xi_from] -= share * found.by_xi;
        cell.gradient[corner.eta_to] += share * found.by_eta;
        cell.gradient[corner.eta_from] -= share * found.by_eta;
        cell.gradient[corner.at] += share * found.by_weight * weight.slope[at];
    }
    return cell;
}

/// The sum of `term(CornerEdges, weight at the corner)` over all corners.
template <class Term>
DiscreteFunctional sum_over_corners(const NodeArray& nodes, const Weight& weight, const Term& term) {
    const NodalWeight at_nodes = nodal_weight(nodes, weight);
    if (!at_nodes.finite) {
        return {infinite, {}};
    }
    const int cell_rows = nodes.rows - 1;
    const int cell_columns = nodes.columns - 1;
    std::vector<CellTerms> cells(static_cast<std::size_t>(cell_rows) *
                                 static_cast<std::size_t>(cell_columns));
    const auto cell = [&](int i, int j) -> CellTerms& {
        return cells[static_cast<std::size_t>(i) * static_cast<std::size_t>(cell_columns) +
                     static_cast<std::size_t>(j)];
    };
    for_rows(cell_rows, cell_columns, [&](int i) {
        for (int j = 0; j < cell_columns; ++j) {
            cell(i, j) = cell_terms(nodes, at_nodes, term, i, j);
        }
    });
    DiscreteFunctional found;
    for (const CellTerms& terms : cells) {
        found.value += terms.value;
    }
    if (!std::isfinite(found.value)) {
        return {infinite, {}};
    }
    found.gradient = NodeArray(nodes.rows, nodes.columns);
    for_rows(nodes.rows, nodes.columns, [&](int i) {
        for (int j = 0; j < nodes.columns; ++j) {
            Vec2& sum = found.gradient.at(i, j);
            for (std::size_t k = 0; k < 4; ++k) { // as node k of the cell at (ci, cj)
                const int ci = i - (k == 1 || k == 2 ? 1 : 0);
                const int cj = j - (k == 2 || k == 3 ? 1 : 0);
                if (ci >= 0 && ci < cell_rows && cj >= 0 && cj < cell_columns) {
                    sum += cell(ci, cj).gradient[k];
                }
            }
        }
    });
    return found;
}

} // namespace millwright::grid::internal

namespace millwright::grid {

// The energy of a harmonic map (Winslow 1967; Dvinsky 1991) under the metric M = diag(m^2, 1), m along the
// tracks: over the corners of the cells (x_xi' M x_xi + x_eta' M x_eta) / (sqrt(det M) J). Where m is large,
// nodes of one track come close together, and tracks stay where they are as far as they can. With one m for
// both directions nothing would move, for in the plane the energy does not know the scale of a metric.

/// As discrete_functional(); `m` is positive. Parallel over rows, same bytes on any number of threads. Throws
/// Error if `m` does.
[[nodiscard]] DiscreteFunctional
harmonic_functional(const NodeArray& nodes, const Weight& m, TrackDirection direction);

} // namespace millwright::grid
