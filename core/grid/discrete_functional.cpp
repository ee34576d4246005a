#include "core/grid/discrete_functional.h"

#include "core/base/numbers.h"
#include "core/grid/internal/rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace millwright::grid {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double share = 0.25; // of one corner in its cell

/// Nodes of a cell: 0 at (i, j), 1 at (i+1, j), 2 at (i+1, j+1), 3 at (i, j+1).
struct Corner {
    std::size_t at;               ///< the node whose weight counts
    std::size_t xi_from, xi_to;   ///< the edge along the first direction
    std::size_t eta_from, eta_to; ///< the edge along the second
};
constexpr std::array<Corner, 4> corners{{{0, 0, 1, 0, 3}, {1, 0, 1, 1, 2}, {2, 3, 2, 1, 2}, {3, 3, 2, 0, 3}}};

struct CellTerms {
    double value = 0.0;
    std::array<Vec2, 4> gradient{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
};

struct NodalWeight {
    std::vector<double> w;
    std::vector<Vec2> slope;
    bool finite = false;
};

NodalWeight nodal_weight(const NodeArray& nodes, const Weight& weight) {
    NodalWeight found{weight_at_nodes(weight, nodes), std::vector<Vec2>(nodes.nodes.size()), false};
    for_pieces(found.slope.size(), [&](std::size_t first, std::size_t count) {
        weight.gradients(std::span(nodes.nodes).subspan(first, count),
                         std::span(found.slope).subspan(first, count));
    });
    found.finite = std::ranges::all_of(found.w, [](double w) { return std::isfinite(w); }) &&
                   std::ranges::all_of(found.slope, [](const Vec2& s) { return is_finite(s); });
    return found;
}

void add_corner(CellTerms& cell,
                const std::array<Vec2, 4>& p,
                const Corner& corner,
                double w,
                const Vec2& slope,
                const FunctionalWeights& lambda) {
    const Vec2 xi = p[corner.xi_to] - p[corner.xi_from];
    const Vec2 eta = p[corner.eta_to] - p[corner.eta_from];
    const double J = xi.x() * eta.y() - eta.x() * xi.y();
    if (!(J > 0.0)) {
        cell.value = infinity;
        return;
    }
    const Vec2 J_xi(eta.y(), -eta.x()); // dJ / d(xi edge)
    const Vec2 J_eta(-xi.y(), xi.x());
    const double V = 2.0 * lambda.adaptation * w;
    const double O = lambda.orthogonality;
    const double smoothness = (xi.squaredNorm() + eta.squaredNorm()) / J;
    const double product = xi.dot(eta);
    cell.value += share * (smoothness + V * J * J + O * product * product);

    const double by_J = share * (-smoothness / J + 2.0 * V * J);
    const Vec2 by_xi = by_J * J_xi + 2.0 * share * (xi / J + O * product * eta);
    const Vec2 by_eta = by_J * J_eta + 2.0 * share * (eta / J + O * product * xi);
    cell.gradient[corner.xi_to] += by_xi;
    cell.gradient[corner.xi_from] -= by_xi;
    cell.gradient[corner.eta_to] += by_eta;
    cell.gradient[corner.eta_from] -= by_eta;
    cell.gradient[corner.at] += share * 2.0 * lambda.adaptation * J * J * slope;
}

CellTerms
cell_terms(const NodeArray& nodes, const NodalWeight& weight, const FunctionalWeights& lambda, int i, int j) {
    const std::array<std::size_t, 4> index{
        nodes.index(i, j), nodes.index(i + 1, j), nodes.index(i + 1, j + 1), nodes.index(i, j + 1)};
    const std::array<Vec2, 4> p{
        nodes.nodes[index[0]], nodes.nodes[index[1]], nodes.nodes[index[2]], nodes.nodes[index[3]]};
    CellTerms cell;
    for (const Corner& corner : corners) {
        const std::size_t at = index[corner.at];
        add_corner(cell, p, corner, weight.w[at], weight.slope[at], lambda);
    }
    return cell;
}

} // namespace

DiscreteFunctional
discrete_functional(const NodeArray& nodes, const Weight& weight, const FunctionalWeights& lambda) {
    const NodalWeight at_nodes = nodal_weight(nodes, weight);
    if (!at_nodes.finite) {
        return {infinity, {}};
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
            cell(i, j) = cell_terms(nodes, at_nodes, lambda, i, j);
        }
    });
    DiscreteFunctional found;
    for (const CellTerms& terms : cells) {
        found.value += terms.value;
    }
    if (!std::isfinite(found.value)) {
        return {infinity, {}};
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

} // namespace millwright::grid
