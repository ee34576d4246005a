// Where the tracks themselves should lie: of many candidates between the outer two, those whose best nodes
// cost least together, at distances that keep the scallop height.
#pragma once

#include <optional>
#include <span>
#include <vector>

namespace millwright::grid {

/// The `count` of costs.size() candidates, ascending, with the least sum of costs: the first and the last are
/// among them, and neighbours are `nearest` to `furthest` candidates apart. By dynamic programming, exact.
/// Nothing if there is no such choice of finite cost. Throws Defect unless count >= 2 and
/// 1 <= nearest <= furthest.
[[nodiscard]] std::optional<std::vector<int>>
cheapest_choice(std::span<const double> costs, int count, int nearest, int furthest);

} // namespace millwright::grid
