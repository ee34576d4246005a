#include "core/geometry/outline_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::geometry {

namespace {

constexpr std::size_t few_edges = 4; // looked at one by one
/// Of the patch's side: what is nearer to a box is not decided by the box, but as the single edges have it.
constexpr double outline_rounding = 1e-9;

/// Whether the way from `a` to `b` may come into the box.
bool may_meet(const Vec2& low, const Vec2& high, const Vec2& a, const Vec2& b) {
    const Vec2 middle = 0.5 * (low + high);
    const Vec2 half = 0.5 * (high - low) + Vec2::Constant(outline_rounding);
    const Vec2 way = b - a;
    const Vec2 apart = (0.5 * (a + b) - middle).cwiseAbs() - 0.5 * way.cwiseAbs();
    return apart.x() <= half.x() && apart.y() <= half.y() &&
           std::abs(cross(way, middle - a)) <= std::abs(way.x()) * half.y() + std::abs(way.y()) * half.x();
}

} // namespace

OutlineTree::OutlineTree(const Trim& trim) {
    for (const Trim::Loop& loop : trim.loops) {
        const std::size_t first = corners_.size();
        corners_.insert(corners_.end(), loop.begin(), loop.end());
        corners_.push_back(loop.front());
        loops_.push_back(stretches_.size());
        add(first, corners_.size() - 1);
    }
}

void OutlineTree::add(std::size_t first, std::size_t last) {
    Stretch stretch{corners_[first], corners_[first], first, last, 0};
    for (std::size_t n = first + 1; n <= last; ++n) {
        stretch.low = stretch.low.cwiseMin(corners_[n]);
        stretch.high = stretch.high.cwiseMax(corners_[n]);
    }
    const std::size_t own = stretches_.size();
    stretches_.push_back(stretch);
    if (last - first > few_edges) {
        const std::size_t middle = first + (last - first) / 2;
        add(first, middle);
        stretches_[own].second = stretches_.size();
        add(middle, last);
    }
}

bool OutlineTree::contains(const Vec2& uv) const {
    const Vec2 at = off_the_border(uv);
    bool odd = loops_.empty();
    for (const std::size_t loop : loops_) {
        odd = odd != odd_on_right(loop, at);
    }
    return odd;
}

/// Whether an odd number of its edges crosses the ray from `at` along u. Where all of them lie on the right,
/// the two ends of the stretch tell.
bool OutlineTree::odd_on_right(std::size_t number, const Vec2& at) const {
    const Stretch& stretch = stretches_[number];
    const auto above = [&](std::size_t n) { return corners_[n].y() > at.y(); };
    if (stretch.high.y() <= at.y() || stretch.low.y() > at.y() ||
        stretch.high.x() < at.x() - outline_rounding) {
        return false;
    }
    if (stretch.low.x() > at.x() + outline_rounding) {
        return above(stretch.first) != above(stretch.last);
    }
    if (stretch.second != 0) {
        return odd_on_right(number + 1, at) != odd_on_right(stretch.second, at);
    }
    bool odd = false;
    for (std::size_t n = stretch.first; n < stretch.last; ++n) {
        odd = odd != crosses_ray(corners_[n], corners_[n + 1], at);
    }
    return odd;
}

void OutlineTree::add_crossings(std::size_t number,
                                const Vec2& a,
                                const Vec2& b,
                                std::vector<double>& shares) const {
    const Stretch& stretch = stretches_[number];
    if (!may_meet(stretch.low, stretch.high, a, b)) {
        return;
    }
    if (stretch.second != 0) {
        add_crossings(number + 1, a, b, shares);
        add_crossings(stretch.second, a, b, shares);
        return;
    }
    for (std::size_t n = stretch.first; n < stretch.last; ++n) {
        if (const auto share = crossing(a, b - a, corners_[n], corners_[n + 1])) {
            shares.push_back(*share);
        }
    }
}

std::vector<WayPart> OutlineTree::parts_inside(const Vec2& a, const Vec2& b) const {
    if (loops_.empty()) {
        return {{0.0, 1.0}};
    }
    std::vector<double> shares;
    for (const std::size_t loop : loops_) {
        add_crossings(loop, a, b, shares);
    }
    return parts_between(std::move(shares), [&](double share) { return contains(a + share * (b - a)); });
}

} // namespace millwright::geometry
