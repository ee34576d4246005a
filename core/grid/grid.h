// Where on the surface to touch. A Grid is an array of nodes in the parameter domain of one patch, fold-free;
// tracks of the tool follow its rows or columns. This room makes grids and makes them better: the elliptic
// solver (Brackbill and Saltzman 1982), the outer loop that adapts to an error, the track optimiser. It knows
// no machine: the error of a move comes in as an ErrorModel.
#pragma once

#include "core/grid/node_array.h"

namespace millwright::grid {

/// Which grid lines the tool follows. Along v (the thesis's listing): track i visits nodes (i, 0) ... (i,
/// nv-1).
enum class TrackDirection { along_u, along_v };

/// n_u x n_v nodes in [0,1] x [0,1], every cell positively oriented. Cannot exist folded or not finite.
class Grid {
public:
    /// Throws Defect unless at least 2 x 2, finite, inside [0,1]^2 and fold-free.
    explicit Grid(NodeArray nodes);

    /// Nodes at (i/(nu-1), j/(nv-1)). Throws Defect if nu or nv is below 2.
    [[nodiscard]] static Grid uniform(int nu, int nv);

    [[nodiscard]] int nu() const { return array_.rows; }
    [[nodiscard]] int nv() const { return array_.columns; }
    [[nodiscard]] const Vec2& node(int i, int j) const { return array_.at(i, j); }
    [[nodiscard]] const NodeArray& array() const { return array_; }
    [[nodiscard]] double min_jacobian() const { return min_corner_jacobian(array_); }

    /// Tracks and nodes per track when followed along `direction`.
    [[nodiscard]] int track_count(TrackDirection direction) const;
    [[nodiscard]] int nodes_per_track(TrackDirection direction) const;
    /// Node `k` of track `t`.
    [[nodiscard]] const Vec2& track_node(TrackDirection direction, int t, int k) const;

    friend bool operator==(const Grid&, const Grid&) = default;

private:
    NodeArray array_;
};

} // namespace millwright::grid
