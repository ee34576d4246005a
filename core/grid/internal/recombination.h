// The best of what the last cycles of a multigrid method found, put together: the combination of their nodes
// whose residuals, were they linear, would be smallest. Source: Washio and Oosterlee, ETNA 6, 1997.
#pragma once

#include "core/grid/node_array.h"

#include <cstddef>
#include <deque>
#include <vector>

namespace millwright::grid {

class Recombination {
public:
    [[nodiscard]] bool empty() const { return past_.empty(); }

    /// Nodes better than `nodes`, whose residuals are `residuals`; `nodes` themselves where what is
    /// remembered says nothing. They have not been checked for soundness yet.
    [[nodiscard]] NodeArray best(const NodeArray& nodes, const NodeArray& residuals) const;

    /// Nodes and what their residuals are.
    void remember(const NodeArray& nodes, const NodeArray& residuals);

    /// What is remembered at most, for each node.
    [[nodiscard]] static std::size_t bytes_per_node();

private:
    struct Found {
        std::vector<Vec2> nodes, residuals;
    };

    std::deque<Found> past_;
};

} // namespace millwright::grid
