#include "core/geometry/trim.h"

#include "core/geometry/outline_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::geometry {

namespace {

using Loop = Trim::Loop;

const Vec2& next_corner(const Loop& loop, std::size_t n) {
    return loop[n + 1 == loop.size() ? 0 : n + 1];
}

/// Of what the loop goes around, counterclockwise above zero.
double area(const Loop& loop) {
    double doubled = 0.0;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        doubled += cross(loop[n], next_corner(loop, n));
    }
    return 0.5 * doubled;
}

/// The loop with only what lies where `inside` >= 0, a linear function of the place (Sutherland and Hodgman
/// 1974). Where that falls into several parts they hang together by edges there and back.
template <typename Inside> Loop cut(const Loop& loop, Inside inside) {
    Loop left;
    for (std::size_t n = 0; n < loop.size(); ++n) {
        const Vec2& a = loop[n];
        const Vec2& b = next_corner(loop, n);
        const double at_a = inside(a);
        const double at_b = inside(b);
        if (at_a >= 0.0) {
            left.push_back(a);
        }
        if ((at_a >= 0.0) != (at_b >= 0.0)) {
            left.emplace_back(a + at_a / (at_a - at_b) * (b - a));
        }
    }
    return left;
}

Loop in_unit_square(Loop loop) {
    for (int axis = 0; axis < 2; ++axis) {
        loop = cut(loop, [axis](const Vec2& p) { return p[axis]; });
        loop = cut(loop, [axis](const Vec2& p) { return 1.0 - p[axis]; });
    }
    for (Vec2& corner : loop) {
        corner = corner.cwiseMax(0.0).cwiseMin(1.0);
    }
    return loop;
}

/// Where the way from `a` to `b` crosses an edge, as shares of it.
std::vector<double> shares_of_crossings(const Trim& trim, const Vec2& a, const Vec2& b) {
    std::vector<double> shares;
    for (const Loop& loop : trim.loops) {
        for (std::size_t n = 0; n < loop.size(); ++n) {
            if (const auto share = crossing(a, b - a, loop[n], next_corner(loop, n))) {
                shares.push_back(*share);
            }
        }
    }
    return shares;
}

} // namespace

bool Trim::contains(const Vec2& uv) const {
    if (everything()) {
        return true;
    }
    const Vec2 at = off_the_border(uv);
    bool odd = false;
    for (const Loop& loop : loops) {
        for (std::size_t n = 0; n < loop.size(); ++n) {
            odd = odd != crosses_ray(loop[n], next_corner(loop, n), at);
        }
    }
    return odd;
}

std::vector<WayPart> parts_inside(const Trim& trim, const Vec2& a, const Vec2& b) {
    if (trim.everything()) {
        return {{0.0, 1.0}};
    }
    return parts_between(shares_of_crossings(trim, a, b),
                         [&](double share) { return trim.contains(a + share * (b - a)); });
}

std::optional<Trim> trim_in_square(const std::vector<Loop>& loops, const Vec2& corner) {
    constexpr double rounding = 1e-9; // of the square's area
    Trim trim;
    double covered = 0.0; // each loop that is left around another one counts against it
    for (Loop loop : loops) {
        for (Vec2& place : loop) {
            place -= corner;
        }
        loop = in_unit_square(std::move(loop));
        const double own = loop.size() < 3 ? 0.0 : std::abs(area(loop));
        if (own > rounding) {
            covered += trim.loops.empty() ? own : -own;
            trim.loops.push_back(std::move(loop));
        }
    }
    if (trim.loops.empty() || std::abs(covered) < rounding) {
        return std::nullopt;
    }
    return trim.loops.size() == 1 && covered > 1.0 - rounding ? Trim{} : trim;
}

} // namespace millwright::geometry
