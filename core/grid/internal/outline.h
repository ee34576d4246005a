// The outline of an array whose nodes may slide along it: a rectangle with its sides along the axes.
#pragma once

#include "core/grid/node_array.h"

namespace millwright::grid {

/// Which way a node may go: 1 or 0 along x and along y.
[[nodiscard]] inline Vec2 freedom(const NodeArray& nodes, int i, int j, bool sliding) {
    const bool on_row_side = i == 0 || i == nodes.rows - 1;
    const bool on_column_side = j == 0 || j == nodes.columns - 1;
    if (!on_row_side && !on_column_side) {
        return {1.0, 1.0};
    }
    const bool corner = on_row_side && on_column_side;
    return sliding && !corner ? Vec2(on_row_side ? 0.0 : 1.0, on_row_side ? 1.0 : 0.0) : Vec2::Zero();
}

/// Whether row sides have one x each and column sides one y each.
[[nodiscard]] bool is_axis_rectangle(const NodeArray& nodes);

/// The index whose mirror image stands at `k` of the wider array; -1 and `count` are across the sides.
[[nodiscard]] constexpr int mirrored_index(int k, int count) {
    return k < 0 ? 1 : (k >= count ? count - 2 : k);
}

/// `nodes` with one more ring around: what lies across each side, mirrored in that side.
[[nodiscard]] NodeArray with_mirrored_ring(const NodeArray& nodes);

/// The same ring for values at the nodes.
[[nodiscard]] std::vector<double>
with_mirrored_ring(const std::vector<double>& values, int rows, int columns);

} // namespace millwright::grid
