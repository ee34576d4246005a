// The outlines of a trimmed patch, sorted by where they run, for ways that ask about them again and again.
#pragma once

#include "core/base/numbers.h"
#include "core/geometry/trim.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace millwright::geometry {

// What a single edge of an outline says of a place and of a way, and what follows from all of them: one
// answer for those who look at every edge and those who look at a few.

/// Where a place is asked about: off the border of the patch, along which loops may run, there and back.
[[nodiscard]] inline Vec2 off_the_border(const Vec2& uv) {
    constexpr double off = 1e-7;
    return uv.cwiseMax(off).cwiseMin(1.0 - off);
}

/// Whether the edge from `a` to `b` crosses the ray from `at` along u.
[[nodiscard]] inline bool crosses_ray(const Vec2& a, const Vec2& b, const Vec2& at) {
    return (a.y() > at.y()) != (b.y() > at.y()) &&
           at.x() < a.x() + (at.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
}

/// The share of the way from `start`, `way` long, at which it crosses the edge from `a` to `b`; nothing at
/// its ends, and where the two are parallel.
[[nodiscard]] inline std::optional<double>
crossing(const Vec2& start, const Vec2& way, const Vec2& a, const Vec2& b) {
    const Vec2 edge = b - a;
    const double turn = cross(way, edge);
    if (exactly_equal(turn, 0.0)) {
        return std::nullopt;
    }
    const double along_way = cross(a - start, edge) / turn;
    const double along_edge = cross(a - start, way) / turn;
    const bool meets = along_way > 0.0 && along_way < 1.0 && along_edge >= 0.0 && along_edge <= 1.0;
    return meets ? std::optional(along_way) : std::nullopt;
}

/// parts_inside(), of a way that crosses edges at `crossings`; `inside` tells of a share of it.
template <class Inside>
[[nodiscard]] std::vector<WayPart> parts_between(std::vector<double> crossings, const Inside& inside) {
    constexpr double shortest = 1e-6;
    crossings.insert(crossings.end(), {0.0, 1.0});
    std::ranges::sort(crossings);
    std::vector<WayPart> parts;
    for (std::size_t n = 1; n < crossings.size(); ++n) {
        const double from = crossings[n - 1];
        const double to = crossings[n];
        if (to - from < shortest || !inside(0.5 * (from + to))) {
            continue;
        }
        if (!parts.empty() && from - parts.back().to < shortest) {
            parts.back().to = to;
        } else {
            parts.push_back({from, to});
        }
    }
    return parts;
}

/// Answers as the Trim does, in the time of the edges that a place or a way comes near and the logarithm of
/// their number: stretches of a loop are halved down to single edges, each in the box that holds it.
class OutlineTree {
public:
    explicit OutlineTree(const Trim& trim);

    /// As Trim::contains.
    [[nodiscard]] bool contains(const Vec2& uv) const;
    /// As parts_inside.
    [[nodiscard]] std::vector<WayPart> parts_inside(const Vec2& a, const Vec2& b) const;

private:
    /// A stretch of a loop: the edges from corner `first` to corner `last`, which follow each other. Its
    /// first half comes next in `stretches_`, its second half at `second`; 0: it is not halved.
    struct Stretch {
        Vec2 low, high; ///< of the box
        std::size_t first = 0, last = 0;
        std::size_t second = 0;
    };

    void add(std::size_t first, std::size_t last);
    [[nodiscard]] bool odd_on_right(std::size_t stretch, const Vec2& at) const;
    void add_crossings(std::size_t stretch, const Vec2& a, const Vec2& b, std::vector<double>& shares) const;

    std::vector<Vec2> corners_; ///< of all loops, of each the first one at its end again
    std::vector<Stretch> stretches_;
    std::vector<std::size_t> loops_; ///< the stretch of each whole loop
};

} // namespace millwright::geometry
