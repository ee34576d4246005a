#include "core/grid/elliptic_equations.h"

#include "core/base/error.h"
#include "core/grid/internal/node_step.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double vanishing_jacobian = 1e-100; // its cube is still a number

/// First and second differences of the mapping at one node.
struct Differences {
    double x_xi, x_eta, y_xi, y_eta;
    double x_xixi, x_xieta, x_etaeta, y_xixi, y_xieta, y_etaeta;
    double J;
};

/// Coefficients of the second differences: a couples x and y, b stands with x, c with y.
struct Coefficients {
    double a1, a2, a3, b1, b2, b3, c1, c2, c3;
};

struct Slope {
    double w_x = 0.0, w_y = 0.0;
};

NodeStencil stencil(const NodeArray& nodes, std::span<const double> w, int i, int j) {
    NodeStencil s;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            s.p[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)] = nodes.at(i + a - 1, j + b - 1);
        }
    }
    s.w = w[nodes.index(i, j)];
    s.w_before = w[nodes.index(i - 1, j)];
    s.w_after = w[nodes.index(i + 1, j)];
    s.w_below = w[nodes.index(i, j - 1)];
    s.w_above = w[nodes.index(i, j + 1)];
    return s;
}

Differences differences(const NodeStencil& s, const IndexDensity& n) {
    const auto& p = s.p;
    const Vec2 xi = (p[2][1] - p[0][1]) * (0.5 * n.xi);
    const Vec2 eta = (p[1][2] - p[1][0]) * (0.5 * n.eta);
    const Vec2 xixi = (p[2][1] - 2.0 * p[1][1] + p[0][1]) * (n.xi * n.xi);
    const Vec2 etaeta = (p[1][2] - 2.0 * p[1][1] + p[1][0]) * (n.eta * n.eta);
    const Vec2 xieta = (p[2][2] + p[0][0] - p[2][0] - p[0][2]) * (0.25 * n.xi * n.eta);
    const double J = xi.x() * eta.y() - eta.x() * xi.y();
    return {xi.x(),
            eta.x(),
            xi.y(),
            eta.y(),
            xixi.x(),
            xieta.x(),
            etaeta.x(),
            xixi.y(),
            xieta.y(),
            etaeta.y(),
            J};
}

// Eqs 9 to 13; 8b with +C, 11 with -2 beta.
Coefficients smoothness(const Differences& d) {
    if (std::abs(d.J) < vanishing_jacobian) {
        return {};
    }
    const double J3 = d.J * d.J * d.J;
    const double alpha = (d.x_eta * d.x_eta + d.y_eta * d.y_eta) / J3;
    const double beta = (d.x_xi * d.x_eta + d.y_xi * d.y_eta) / J3;
    const double gamma = (d.x_xi * d.x_xi + d.y_xi * d.y_xi) / J3;
    const double A = d.x_xi * d.y_xi + d.x_eta * d.y_eta;
    const double B = d.y_xi * d.y_xi + d.y_eta * d.y_eta;
    const double C = d.x_xi * d.x_xi + d.x_eta * d.x_eta;
    return {.a1 = -A * alpha,
            .a2 = 2.0 * A * beta,
            .a3 = -A * gamma,
            .b1 = B * alpha,
            .b2 = -2.0 * B * beta,
            .b3 = B * gamma,
            .c1 = C * alpha,
            .c2 = -2.0 * C * beta,
            .c3 = C * gamma};
}

// Eqs 15 to 17.
Coefficients volume(const Differences& d) {
    return {.a1 = -d.x_eta * d.y_eta,
            .a2 = d.x_xi * d.y_eta + d.x_eta * d.y_xi,
            .a3 = -d.x_xi * d.y_xi,
            .b1 = d.y_eta * d.y_eta,
            .b2 = -2.0 * d.y_xi * d.y_eta,
            .b3 = d.y_xi * d.y_xi,
            .c1 = d.x_eta * d.x_eta,
            .c2 = -2.0 * d.x_xi * d.x_eta,
            .c3 = d.x_xi * d.x_xi};
}

// The Euler equations of (x_xi x_eta + y_xi y_eta)^2; the listing lost a factor 2 in b2 and a product in c2.
Coefficients orthogonality(const Differences& d) {
    const double xx = d.x_xi * d.x_eta;
    const double yy = d.y_xi * d.y_eta;
    return {.a1 = d.x_eta * d.y_eta,
            .a2 = d.x_xi * d.y_eta + d.x_eta * d.y_xi,
            .a3 = d.x_xi * d.y_xi,
            .b1 = d.x_eta * d.x_eta,
            .b2 = 2.0 * (2.0 * xx + yy),
            .b3 = d.x_xi * d.x_xi,
            .c1 = d.y_eta * d.y_eta,
            .c2 = 2.0 * (xx + 2.0 * yy),
            .c3 = d.y_xi * d.y_xi};
}

// Eq 18, with the factor 2w that it lost.
Coefficients combined_coefficients(const Differences& d, double w, const FunctionalWeights& lambda) {
    const Coefficients s = smoothness(d);
    const Coefficients v = volume(d);
    const Coefficients o = orthogonality(d);
    const double V = 2.0 * w * lambda.adaptation;
    const double O = lambda.orthogonality;
    return {.a1 = s.a1 + V * v.a1 + O * o.a1,
            .a2 = s.a2 + V * v.a2 + O * o.a2,
            .a3 = s.a3 + V * v.a3 + O * o.a3,
            .b1 = s.b1 + V * v.b1 + O * o.b1,
            .b2 = s.b2 + V * v.b2 + O * o.b2,
            .b3 = s.b3 + V * v.b3 + O * o.b3,
            .c1 = s.c1 + V * v.c1 + O * o.c1,
            .c2 = s.c2 + V * v.c2 + O * o.c2,
            .c3 = s.c3 + V * v.c3 + O * o.c3};
}

Slope chain_rule_slope(const NodeStencil& s, const IndexDensity& n, const Differences& d) {
    if (std::abs(d.J) < vanishing_jacobian) {
        return {};
    }
    const double w_xi = (s.w_after - s.w_before) * (0.5 * n.xi);
    const double w_eta = (s.w_above - s.w_below) * (0.5 * n.eta);
    return {.w_x = (w_xi * d.y_eta - w_eta * d.y_xi) / d.J, .w_y = (d.x_xi * w_eta - d.x_eta * w_xi) / d.J};
}

/// The listing's own faults: w_y divides by a difference of x and reads w at (i-1, j-1).
Slope listed_slope(const NodeArray& p, std::span<const double> w, int i, int j) {
    const auto quotient = [](double over, double under) {
        return std::abs(under) > 0.0 ? over / under : 0.0;
    };
    return {
        .w_x = quotient(w[p.index(i + 1, j)] - w[p.index(i - 1, j)], p.at(i + 1, j).x() - p.at(i - 1, j).x()),
        .w_y = quotient(w[p.index(i, j + 1)] - w[p.index(i - 1, j - 1)],
                        p.at(i, j + 1).x() - p.at(i, j - 1).x())};
}

NodeEquations equations_of(const Differences& d,
                           double w,
                           const Slope& slope,
                           const FunctionalWeights& lambda,
                           const IndexDensity& n) {
    const auto [a1, a2, a3, b1, b2, b3, c1, c2, c3] = combined_coefficients(d, w, lambda);
    const double LV = lambda.adaptation;
    const double xi = n.xi * n.xi;
    const double eta = n.eta * n.eta;
    NodeEquations e;
    e.R_X = b1 * d.x_xixi + b2 * d.x_xieta + b3 * d.x_etaeta + a1 * d.y_xixi + a2 * d.y_xieta +
            a3 * d.y_etaeta + LV * d.J * d.J * slope.w_x;
    e.R_Y = a1 * d.x_xixi + a2 * d.x_xieta + a3 * d.x_etaeta + c1 * d.y_xixi + c2 * d.y_xieta +
            c3 * d.y_etaeta + LV * d.J * d.J * slope.w_y;
    e.R_XX = -2.0 * (b1 * xi + b3 * eta);
    e.R_XY = -2.0 * (a1 * xi + a3 * eta);
    e.R_YY = -2.0 * (c1 * xi + c3 * eta);
    e.J = d.J;
    return e;
}

} // namespace

NodeEquations
node_equations(const NodeStencil& at, const FunctionalWeights& lambda, const IndexDensity& density) {
    const Differences d = differences(at, density);
    return equations_of(d, at.w, chain_rule_slope(at, density, d), lambda, density);
}

NodeEquations
node_equations(const NodeArray& nodes, std::span<const double> w, const EquationRules& rules, int i, int j) {
    const NodeStencil at = stencil(nodes, w, i, j);
    const Differences d = differences(at, {});
    const Slope slope = rules.derivatives == WeightDerivatives::chain_rule ? chain_rule_slope(at, {}, d)
                                                                           : listed_slope(nodes, w, i, j);
    return equations_of(d, at.w, slope, rules.functional, {});
}

std::vector<NodeEquations> all_equations(const NodeArray& nodes,
                                         std::span<const double> w,
                                         const EquationRules& rules,
                                         std::vector<NodeEquations> reused) {
    std::vector<NodeEquations> equations = std::move(reused);
    expects(w.size() == nodes.nodes.size(), "every node has a weight");
    if (equations.size() != nodes.nodes.size()) {
        equations.assign(nodes.nodes.size(), {});
    }
    for_rows(nodes.rows, nodes.columns, [&](int i) {
        if (i == 0 || i == nodes.rows - 1) {
            return;
        }
        for (int j = 1; j + 1 < nodes.columns; ++j) {
            equations[nodes.index(i, j)] = node_equations(nodes, w, rules, i, j);
        }
    });
    return equations;
}

double residual_norm(std::span<const NodeEquations> equations) {
    double largest = 0.0;
    for (const NodeEquations& e : equations) {
        const double here = (std::abs(e.R_X) + std::abs(e.R_Y)) / 2.0;
        if (!std::isfinite(here)) { // kept, so that no maximum over the other nodes hides it
            return here;
        }
        largest = std::max(largest, here);
    }
    return largest;
}

NodeArray residuals(std::span<const NodeEquations> equations, int rows, int columns) {
    NodeArray array(rows, columns);
    expects(array.nodes.size() == equations.size(), "every node has its equations");
    std::ranges::transform(equations, array.nodes.begin(), [](const NodeEquations& e) -> Vec2 {
        return {e.R_X, e.R_Y};
    });
    return array;
}

} // namespace millwright::grid
