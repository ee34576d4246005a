#include "core/plot/carving/internal/segment_tree.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace millwright::plot::internal {
namespace {

constexpr int segments_per_leaf = 4;

double distance_to_segment(const Vec2& place, const Segment2& segment) {
    const Vec2 along = segment.b - segment.a;
    const double square = along.squaredNorm();
    const double t = square > 0.0 ? std::clamp((place - segment.a).dot(along) / square, 0.0, 1.0) : 0.0;
    return (segment.a + t * along - place).norm();
}

double distance_to_box(const Vec2& place, const Vec2& lower, const Vec2& upper) {
    return (lower - place).cwiseMax(place - upper).cwiseMax(0.0).norm();
}

} // namespace

SegmentTree::SegmentTree(std::vector<Segment2> segments)
    : segments_(std::move(segments)), order_(segments_.size()) {
    std::iota(order_.begin(), order_.end(), 0);
    if (!segments_.empty()) {
        build(0, static_cast<int>(segments_.size()));
    }
}

int SegmentTree::build(int first, int last) {
    Node node{.first = first, .last = last};
    const auto segment = [&](int n) -> const Segment2& { return segments_[static_cast<std::size_t>(n)]; };
    const auto begin = order_.begin() + first;
    const auto end = order_.begin() + last;
    node.lower = segment(*begin).a;
    node.upper = segment(*begin).a;
    for (auto n = begin; n != end; ++n) {
        node.lower = node.lower.cwiseMin(segment(*n).a).cwiseMin(segment(*n).b);
        node.upper = node.upper.cwiseMax(segment(*n).a).cwiseMax(segment(*n).b);
    }
    const int at = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
    if (last - first <= segments_per_leaf) {
        return at;
    }
    const Vec2 size = node.upper - node.lower;
    const Eigen::Index axis = size.x() >= size.y() ? 0 : 1;
    const auto middle = begin + (last - first) / 2;
    std::nth_element(begin, middle, end, [&](int n, int m) {
        const double of_n = segment(n).a[axis] + segment(n).b[axis];
        const double of_m = segment(m).a[axis] + segment(m).b[axis];
        return of_n < of_m || (of_n <= of_m && n < m);
    });
    const int split = static_cast<int>(middle - order_.begin());
    const int left = build(first, split);
    const int right = build(split, last);
    nodes_[static_cast<std::size_t>(at)].left = left;
    nodes_[static_cast<std::size_t>(at)].right = right;
    return at;
}

double SegmentTree::distance(const Vec2& place) const {
    double best = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) {
        nearest_in(0, place, best);
    }
    return best;
}

bool SegmentTree::surrounds(const Vec2& place) const {
    bool inside = false;
    const Vec2 far(std::numeric_limits<double>::infinity(), place.y());
    near(place, far, [&](int n) { // those that the ray in +x may cross
        const auto& [a, b] = segments_[static_cast<std::size_t>(n)];
        if ((a.y() > place.y()) != (b.y() > place.y())) {
            const double share = (place.y() - a.y()) / (b.y() - a.y());
            inside = inside != (a.x() + share * (b.x() - a.x()) > place.x());
        }
    });
    return inside;
}

void SegmentTree::nearest_in(int at, const Vec2& place, double& best) const {
    const Node& node = nodes_[static_cast<std::size_t>(at)];
    if (node.left < 0) {
        for (int n = node.first; n < node.last; ++n) {
            const int segment = order_[static_cast<std::size_t>(n)];
            best = std::min(best, distance_to_segment(place, segments_[static_cast<std::size_t>(segment)]));
        }
        return;
    }
    const auto to = [&](int n) {
        const Node& child = nodes_[static_cast<std::size_t>(n)];
        return distance_to_box(place, child.lower, child.upper);
    };
    std::pair<double, int> near{to(node.left), node.left};
    std::pair<double, int> far{to(node.right), node.right};
    if (far.first < near.first) {
        std::swap(near, far);
    }
    for (const auto& [distance, child] : {near, far}) {
        if (distance < best) {
            nearest_in(child, place, best);
        }
    }
}

} // namespace millwright::plot::internal
