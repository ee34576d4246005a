// Straight segments in a tree of boxes: which is nearest to a place, which meet a box, and what they
// surround. Any one unit.
#pragma once

#include "core/base/progress.h"
#include "core/geometry/vectors.h"
#include "core/plot/carving/internal/outline_segments.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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

// Where segments in whole units cross, overlap or touch. Exact: products of differences fit 64 bits.

/// Above 0 where the way from a over b to c turns left, 0 where it is straight: twice the area of the
/// triangle, square units.
[[nodiscard]] inline std::int64_t turn(const UnitPoint& a, const UnitPoint& b, const UnitPoint& c) {
    const auto from_a = [&](const UnitPoint& p, std::size_t axis) {
        return std::int64_t{p[axis]} - std::int64_t{a[axis]};
    };
    return from_a(b, 0) * from_a(c, 1) - from_a(b, 1) * from_a(c, 0);
}

struct UnitCrossings {
    std::size_t crossing = 0;    ///< pairs that cross in the middle of both
    std::size_t overlapping = 0; ///< pairs that have a length in common
    Vec2 first = Vec2::Zero();   ///< place of the first pair, units
};

/// Throws Cancelled.
[[nodiscard]] UnitCrossings crossings_of(const std::vector<OutlineSegment>& segments,
                                         const Progress& progress);

/// Segments that touch another in its middle split it there. Throws Cancelled.
[[nodiscard]] std::vector<OutlineSegment> split_at_touches(const std::vector<OutlineSegment>& segments,
                                                           const Progress& progress);

/// Without what runs there and back again: the inside is on both of its sides. What runs twice the same way
/// stays once.
[[nodiscard]] std::vector<OutlineSegment> without_shared_sides(std::vector<OutlineSegment> segments);

} // namespace millwright::plot::internal
