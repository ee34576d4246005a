#include "core/grid/descent.h"

#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double least_curvature = 1e-12; // s.y against |s||y|; below, the pair says nothing

} // namespace

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    std::vector<double> sums(pieces_of(a.size()), 0.0);
    for_pieces(a.size(), [&](std::size_t first, std::size_t count) {
        double sum = 0.0;
        for (std::size_t k = first; k < first + count; ++k) {
            sum += a[k].dot(b[k]);
        }
        sums[first / nodes_per_piece] = sum;
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

void add(std::vector<Vec2>& to, double factor, const std::vector<Vec2>& step) {
    for_pieces(to.size(), [&](std::size_t first, std::size_t count) {
        for (std::size_t k = first; k < first + count; ++k) {
            to[k] += factor * step[k];
        }
    });
}

double longest(const std::vector<Vec2>& steps) {
    double found = 0.0;
    for (const Vec2& step : steps) {
        found = std::max(found, step.norm());
    }
    return found;
}

/// The two-loop recursion.
std::vector<Vec2> DescentMemory::direction(const std::vector<Vec2>& gradient) const {
    std::vector<Vec2> d = gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t k = pairs_.size(); k-- > 0;) {
        alpha[k] = pairs_[k].inverse_sy * dot(pairs_[k].s, d);
        add(d, -alpha[k], pairs_[k].y);
    }
    const double scale =
        pairs_.empty() ? 1.0 : 1.0 / (pairs_.back().inverse_sy * dot(pairs_.back().y, pairs_.back().y));
    for (Vec2& step : d) {
        step *= -scale;
    }
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const double beta = pairs_[k].inverse_sy * dot(pairs_[k].y, d);
        add(d, -alpha[k] - beta, pairs_[k].s);
    }
    return d;
}

void DescentMemory::remember(std::vector<Vec2> step, std::vector<Vec2> change) {
    const double sy = dot(step, change);
    if (!(sy > least_curvature * std::sqrt(dot(step, step) * dot(change, change)))) {
        return;
    }
    pairs_.push_back({std::move(step), std::move(change), 1.0 / sy});
    if (pairs_.size() > length) {
        pairs_.pop_front();
    }
}

} // namespace millwright::grid
