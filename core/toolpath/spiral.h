// One path over all nodes of a grid without a lift: round after round from the border to the middle.
#pragma once

#include "core/toolpath/strategy.h"

#include <array>
#include <vector>

namespace millwright::toolpath {

/// Every node [i, j] of nu x nv once, each next to the one before in the grid. Begins at 0, 0 along the
/// tracks of `direction`.
[[nodiscard]] std::vector<std::array<int, 2>> spiral_order(int nu, int nv, grid::TrackDirection direction);

class Spiral final : public Strategy {
public:
    [[nodiscard]] Toolpath contacts(const Covering& of, const Progress& progress) const override;
};

} // namespace millwright::toolpath
