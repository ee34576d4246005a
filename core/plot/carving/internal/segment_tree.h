// Straight segments in a tree of boxes: which is nearest to a place, which meet a box, and what they
// surround. Any one unit.
#pragma once

#include "core/geometry/vectors.h"

#include <algorithm>
#include <vector>

namespace millwright::plot::internal {

struct Segment2 {
    Vec2 a = Vec2::Zero();
    Vec2 b = Vec2::Zero();
};

class SegmentTree {
public:
    explicit SegmentTree(std::vector<Segment2> segments);

    /// From `place` to the nearest segment; infinite without segments.
    [[nodiscard]] double distance(const Vec2& place) const;

    /// Whether closed outlines of the segments surround `place`, by the even-odd rule. On an outline either.
    [[nodiscard]] bool surrounds(const Vec2& place) const;

    /// Calls `visit(n)` for each segment n whose box meets that from `lower` to `upper`.
    template <class Visit> void near(const Vec2& lower, const Vec2& upper, const Visit& visit) const {
        if (!nodes_.empty()) {
            near_in(0, lower, upper, visit);
        }
    }

private:
    struct Node {
        Vec2 lower = Vec2::Zero();
        Vec2 upper = Vec2::Zero();
        int first = 0; ///< in `order_`
        int last = 0;
        int left = -1; ///< node; -1: a leaf
        int right = -1;
    };

    int build(int first, int last);
    void nearest_in(int node, const Vec2& place, double& best) const;

    template <class Visit>
    void near_in(int at, const Vec2& lower, const Vec2& upper, const Visit& visit) const {
        const Node& node = nodes_[static_cast<std::size_t>(at)];
        if ((node.lower - upper).maxCoeff() > 0.0 || (lower - node.upper).maxCoeff() > 0.0) {
            return;
        }
        if (node.left >= 0) {
            near_in(node.left, lower, upper, visit);
            near_in(node.right, lower, upper, visit);
            return;
        }
        for (int n = node.first; n < node.last; ++n) {
            const int segment = order_[static_cast<std::size_t>(n)];
            const Segment2& s = segments_[static_cast<std::size_t>(segment)];
            const bool apart =
                (s.a.cwiseMin(s.b) - upper).maxCoeff() > 0.0 || (lower - s.a.cwiseMax(s.b)).maxCoeff() > 0.0;
            if (!apart) {
                visit(segment);
            }
        }
    }

    std::vector<Segment2> segments_;
    std::vector<int> order_;
    std::vector<Node> nodes_;
};

} // namespace millwright::plot::internal
