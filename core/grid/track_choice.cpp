#include "core/grid/track_choice.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <algorithm>

namespace millwright::grid {

std::optional<std::vector<int>>
cheapest_choice(std::span<const double> costs, int count, int nearest, int furthest) {
    expects(count >= 2 && nearest >= 1 && nearest <= furthest, "two tracks or more, at positive distances");
    const int size = static_cast<int>(std::ssize(costs));
    std::vector<double> reached(costs.size(), infinity);
    std::vector<std::vector<int>> from; // [choices before, candidate]
    if (size > 0) {
        reached[0] = costs[0];
    }
    for (int chosen = 1; chosen < count; ++chosen) {
        std::vector<double> next(costs.size(), infinity);
        std::vector<int>& before = from.emplace_back(costs.size(), -1);
        for (int to = nearest; to < size; ++to) {
            const auto n = static_cast<std::size_t>(to);
            for (int step = nearest; step <= std::min(furthest, to); ++step) {
                const double sum = reached[static_cast<std::size_t>(to - step)] + costs[n];
                if (sum < next[n]) {
                    next[n] = sum;
                    before[n] = to - step;
                }
            }
        }
        reached = std::move(next);
    }
    if (size == 0 || !(reached.back() < infinity)) {
        return std::nullopt;
    }
    std::vector<int> found{size - 1};
    for (auto before = from.rbegin(); before != from.rend(); ++before) {
        found.push_back((*before)[static_cast<std::size_t>(found.back())]);
    }
    std::ranges::reverse(found);
    return found;
}

} // namespace millwright::grid
