// The outlines of a trimmed patch, sorted by where they run, for ways that ask about them again and again.
#pragma once

#include "core/geometry/trim.h"

#include <vector>

namespace millwright::geometry {

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
