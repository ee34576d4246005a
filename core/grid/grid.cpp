#include "core/grid/grid.h"

#include "core/base/error.h"

#include <algorithm>
#include <utility>

namespace millwright::grid {

namespace {

bool in_domain(const Vec2& p) {
    return p.x() >= 0.0 && p.x() <= 1.0 && p.y() >= 0.0 && p.y() <= 1.0;
}

} // namespace

Grid::Grid(NodeArray nodes) : array_(std::move(nodes)) {
    expects(array_.rows >= 2 && array_.columns >= 2, "a grid has at least 2 x 2 nodes");
    expects(all_finite(array_), "the nodes of a grid are finite");
    expects(std::ranges::all_of(array_.nodes, in_domain), "the nodes of a grid lie in [0,1] x [0,1]");
    expects(min_corner_jacobian(array_) > 0.0, "no cell of a grid is folded");
}

Grid Grid::uniform(int nu, int nv) {
    expects(nu >= 2 && nv >= 2, "a grid has at least 2 x 2 nodes");
    NodeArray array(nu, nv);
    for (int i = 0; i < nu; ++i) {
        for (int j = 0; j < nv; ++j) {
            array.at(i, j) = Vec2(static_cast<double>(i) / (nu - 1), static_cast<double>(j) / (nv - 1));
        }
    }
    return Grid(std::move(array));
}

int Grid::track_count(TrackDirection direction) const {
    return direction == TrackDirection::along_v ? nu() : nv();
}

int Grid::nodes_per_track(TrackDirection direction) const {
    return direction == TrackDirection::along_v ? nv() : nu();
}

const Vec2& Grid::track_node(TrackDirection direction, int t, int k) const {
    return direction == TrackDirection::along_v ? node(t, k) : node(k, t);
}

} // namespace millwright::grid
