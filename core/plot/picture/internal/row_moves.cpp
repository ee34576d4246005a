#include "core/plot/picture/internal/row_moves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::plot::internal {

std::vector<Node> nodes_of(const std::vector<float>& heights, double pitch, double allowance) {
    std::vector<Node> nodes;
    nodes.reserve(heights.size());
    for (std::size_t j = 0; j < heights.size(); ++j) {
        nodes.push_back({static_cast<double>(j) * pitch, static_cast<double>(heights[j]) + allowance});
    }
    return nodes;
}

// From the last node that is kept, moves to later ones are possible as long as their slope passes above every
// node between, and not too far.
std::vector<Node> merged(const std::vector<Node>& nodes, double tolerance) {
    constexpr double rounding = 5e-7; // of heights that are floats: equal slopes are equal
    std::vector<Node> kept = {nodes.front()};
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();
    for (std::size_t n = 1; n < nodes.size(); ++n) {
        const Node& from = kept.back();
        const double way = std::abs(nodes[n].x - from.x);
        const double slope = (nodes[n].z - from.z) / way;
        if (slope < least || slope > most) {
            kept.push_back(nodes[n - 1]);
            least = -std::numeric_limits<double>::infinity();
            most = std::numeric_limits<double>::infinity();
            --n;
            continue;
        }
        least = std::max(least, slope - rounding / way);
        most = std::min(most, (nodes[n].z + tolerance + rounding - from.z) / way);
    }
    if (nodes.size() > 1) {
        kept.push_back(nodes.back());
    }
    return kept;
}

std::vector<std::vector<Node>> runs_below(const std::vector<Node>& nodes, double ceiling, double nearest) {
    struct Range {
        std::size_t first = 0;
        std::size_t last = 0;
    };
    std::vector<Range> ranges;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (!(nodes[n].z < ceiling)) {
            continue;
        }
        const Range here{n == 0 ? 0 : n - 1, std::min(n + 1, nodes.size() - 1)};
        const bool near =
            !ranges.empty() && std::abs(nodes[here.first].x - nodes[ranges.back().last].x) < nearest;
        if (near) {
            ranges.back().last = here.last;
        } else {
            ranges.push_back(here);
        }
    }
    std::vector<std::vector<Node>> runs;
    for (const Range& range : ranges) {
        runs.emplace_back(nodes.begin() + static_cast<std::ptrdiff_t>(range.first),
                          nodes.begin() + static_cast<std::ptrdiff_t>(range.last) + 1);
    }
    return runs;
}

} // namespace millwright::plot::internal
