#include "core/grid/internal/recombination.h"

#include "core/grid/descent.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace millwright::grid {

namespace {

constexpr std::size_t memory_length = 4;
constexpr double regularisation = 1e-12; // of the trace: residuals that depend on each other have no say

} // namespace

/// With r the residuals now and d_a = r_a - r those of the past: minimises |r + sum b_a d_a|^2.
NodeArray Recombination::best(const NodeArray& nodes, const NodeArray& residuals) const {
    const auto m = static_cast<Eigen::Index>(past_.size());
    std::vector<std::vector<Vec2>> d;
    for (const Found& found : past_) {
        d.push_back(found.residuals);
        add(d.back(), -1.0, residuals.nodes);
    }
    Eigen::MatrixXd normal(m, m);
    Eigen::VectorXd right(m);
    for (Eigen::Index a = 0; a < m; ++a) {
        const std::vector<Vec2>& d_a = d[static_cast<std::size_t>(a)];
        for (Eigen::Index b = 0; b <= a; ++b) {
            normal(a, b) = dot(d_a, d[static_cast<std::size_t>(b)]);
            normal(b, a) = normal(a, b);
        }
        right(a) = -dot(d_a, residuals.nodes);
    }
    const double trace = m > 0 ? normal.trace() : 0.0;
    if (!(trace > 0.0)) {
        return nodes;
    }
    normal.diagonal().array() += regularisation * trace;
    const Eigen::VectorXd share = normal.ldlt().solve(right);
    NodeArray combined = nodes;
    for (Eigen::Index a = 0; a < m; ++a) {
        std::vector<Vec2> way =
            past_[static_cast<std::size_t>(a)].nodes; // zero to the bit where nodes are fixed
        add(way, -1.0, nodes.nodes);
        add(combined.nodes, share(a), way);
    }
    return combined;
}

void Recombination::remember(const NodeArray& nodes, const NodeArray& residuals) {
    past_.push_back({nodes.nodes, residuals.nodes});
    if (past_.size() > memory_length) {
        past_.pop_front();
    }
}

std::size_t Recombination::bytes_per_node() {
    return ((memory_length + 1) * 2 + memory_length) * sizeof(Vec2);
}

} // namespace millwright::grid
