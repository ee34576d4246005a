#include "core/plot/carving/internal/segment_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
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

namespace {

Vec2 in_plane(const UnitPoint& p) {
    return {static_cast<double>(p[0]), static_cast<double>(p[1])};
}

/// Of three points on a line: c is between a and b, and neither of them.
bool strictly_between(const UnitPoint& a, const UnitPoint& b, const UnitPoint& c) {
    const std::size_t axis = a[0] == b[0] ? 1 : 0;
    return std::min(a[axis], b[axis]) < c[axis] && c[axis] < std::max(a[axis], b[axis]);
}

bool inside_of(const OutlineSegment& s, const UnitPoint& p) {
    return turn(s.a, s.b, p) == 0 && strictly_between(s.a, s.b, p);
}

int sign(std::int64_t value) {
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

bool cross(const OutlineSegment& s, const OutlineSegment& t) {
    return sign(turn(s.a, s.b, t.a)) * sign(turn(s.a, s.b, t.b)) < 0 &&
           sign(turn(t.a, t.b, s.a)) * sign(turn(t.a, t.b, s.b)) < 0;
}

bool overlap(const OutlineSegment& s, const OutlineSegment& t) {
    if (turn(s.a, s.b, t.a) != 0 || turn(s.a, s.b, t.b) != 0) {
        return false;
    }
    const bool same = std::minmax(s.a, s.b) == std::minmax(t.a, t.b);
    return same || strictly_between(s.a, s.b, t.a) || strictly_between(s.a, s.b, t.b) ||
           strictly_between(t.a, t.b, s.a) || strictly_between(t.a, t.b, s.b);
}

Vec2 crossing_place(const OutlineSegment& s, const OutlineSegment& t) {
    const auto before = static_cast<double>(turn(t.a, t.b, s.a));
    const auto behind = static_cast<double>(turn(t.a, t.b, s.b));
    const double part = before - behind;
    const double share = std::abs(part) > 0.0 ? before / part : 0.5;
    return in_plane(s.a) + share * (in_plane(s.b) - in_plane(s.a));
}

/// Calls `visit(n, m)` with n < m for each pair whose boxes meet.
template <class Visit>
void for_near_pairs(const std::vector<OutlineSegment>& segments,
                    const Progress& progress,
                    const Visit& visit) {
    std::vector<Segment2> plain;
    for (const OutlineSegment& s : segments) {
        plain.push_back({in_plane(s.a), in_plane(s.b)});
    }
    const SegmentTree tree(plain);
    constexpr std::size_t often = 1000;
    for (std::size_t n = 0; n < plain.size(); ++n) {
        if (n % often == 0) {
            progress.check();
        }
        const auto& [a, b] = plain[n];
        tree.near(a.cwiseMin(b), a.cwiseMax(b), [&](int m) {
            if (static_cast<std::size_t>(m) > n) {
                visit(n, static_cast<std::size_t>(m));
            }
        });
    }
}

} // namespace

UnitCrossings crossings_of(const std::vector<OutlineSegment>& segments, const Progress& progress) {
    UnitCrossings found;
    std::pair<std::size_t, std::size_t> first{segments.size(), segments.size()};
    for_near_pairs(segments, progress, [&](std::size_t n, std::size_t m) {
        const OutlineSegment& s = segments[n];
        const OutlineSegment& t = segments[m];
        if (cross(s, t)) {
            ++found.crossing;
        } else if (overlap(s, t)) {
            ++found.overlapping;
        } else {
            return;
        }
        if (std::pair(n, m) < first) {
            first = {n, m};
            found.first = crossing_place(s, t);
        }
    });
    return found;
}

std::vector<OutlineSegment> split_at_touches(const std::vector<OutlineSegment>& segments,
                                             const Progress& progress) {
    std::vector<std::vector<UnitPoint>> touches(segments.size());
    const auto note = [&](std::size_t of, const OutlineSegment& other) {
        for (const UnitPoint& end : {other.a, other.b}) {
            if (inside_of(segments[of], end)) {
                touches[of].push_back(end);
            }
        }
    };
    for_near_pairs(segments, progress, [&](std::size_t n, std::size_t m) {
        note(n, segments[m]);
        note(m, segments[n]);
    });
    std::vector<OutlineSegment> result;
    for (std::size_t n = 0; n < segments.size(); ++n) {
        const OutlineSegment& s = segments[n];
        std::vector<UnitPoint>& at = touches[n];
        at.push_back(s.b);
        std::ranges::sort(
            at, {}, [&](const UnitPoint& p) { return (in_plane(p) - in_plane(s.a)).squaredNorm(); });
        at.erase(std::unique(at.begin(), at.end()), at.end());
        UnitPoint from = s.a;
        for (const UnitPoint& to : at) {
            result.push_back({from, to, s.ring});
            from = to;
        }
    }
    return result;
}

std::vector<OutlineSegment> without_shared_sides(std::vector<OutlineSegment> segments) {
    std::map<std::pair<UnitPoint, UnitPoint>, int> balance; ///< forth less back
    for (const OutlineSegment& s : segments) {
        balance[std::minmax(s.a, s.b)] += s.a < s.b ? 1 : -1;
    }
    std::erase_if(segments, [&](const OutlineSegment& s) {
        int& left = balance[std::minmax(s.a, s.b)];
        const bool kept = s.a < s.b ? left > 0 : left < 0;
        left = kept ? 0 : left;
        return !kept;
    });
    return segments;
}

} // namespace millwright::plot::internal
