// A descent by L-BFGS (Nocedal 1980) over the nodes of a grid: what it remembers, and where that leads.
#pragma once

#include "core/geometry/vectors.h"

#include <cstddef>
#include <deque>
#include <vector>

namespace millwright::grid {

/// Parallel, same bytes on any number of threads; so is add().
[[nodiscard]] double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b);

/// to += factor * step
void add(std::vector<Vec2>& to, double factor, const std::vector<Vec2>& step);

/// The length of the longest of `steps`.
[[nodiscard]] double longest(const std::vector<Vec2>& steps);

class DescentMemory {
public:
    static constexpr std::size_t length = 8; ///< steps that are remembered

    /// Downhill from where the gradient is `gradient`: against it while nothing is remembered.
    [[nodiscard]] std::vector<Vec2> direction(const std::vector<Vec2>& gradient) const;

    /// One step, and how the gradient changed along it. Not kept where the curvature says nothing.
    void remember(std::vector<Vec2> step, std::vector<Vec2> change);

    [[nodiscard]] bool empty() const { return pairs_.empty(); }
    void clear() { pairs_.clear(); }

private:
    struct Pair {
        std::vector<Vec2> s, y;
        double inverse_sy = 0.0;
    };

    std::deque<Pair> pairs_;
};

} // namespace millwright::grid
