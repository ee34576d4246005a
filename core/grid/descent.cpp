#include "core/grid/descent.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr std::size_t memory_length = 8;
constexpr double least_curvature = 1e-12; // s.y against |s||y|; below, the pair says nothing

} // namespace

double dot(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
        sum += a[k].dot(b[k]);
    }
    return sum;
}

void add(std::vector<Vec2>& to, double factor, const std::vector<Vec2>& step) {
    for (std::size_t k = 0; k < to.size(); ++k) {
        to[k] += factor * step[k];
    }
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
    if (pairs_.size() > memory_length) {
        pairs_.pop_front();
    }
}

} // namespace millwright::grid
