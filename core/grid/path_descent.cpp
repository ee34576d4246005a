#include "core/grid/path_descent.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double longest_step = 0.3;         // cells, for one node in one iteration
constexpr double sufficient_decrease = 1e-4; // Armijo
constexpr int most_halvings = 20;

} // namespace

PathDescent::PathDescent(PathObjective objective, NodeArray start, const Progress& progress)
    : objective_(std::move(objective)), nodes_(std::move(start)), value_(objective_.value(nodes_, progress)),
      gradient_(objective_.gradient(nodes_, progress)) {
    expects(std::isfinite(value_), "a descent begins where the objective is finite");
}

/// Takes the longest of the halved steps that decreases the objective enough; false if none does.
bool PathDescent::search(const std::vector<Vec2>& direction, const Progress& progress) {
    const double slope = dot(gradient_, direction);
    const double length = longest(direction);
    if (!(slope < 0.0) || !(length > 0.0)) {
        return false;
    }
    double factor = std::min(1.0, longest_step / length);
    for (int halving = 0; halving < most_halvings; ++halving, factor /= 2.0) {
        NodeArray tried = objective_.moved(nodes_, factor, direction);
        const double there = objective_.value(tried, progress);
        if (there <= value_ + sufficient_decrease * factor * slope) {
            std::vector<Vec2> gradient = objective_.gradient(tried, progress);
            std::vector<Vec2> change = gradient;
            add(change, -1.0, gradient_);
            std::vector<Vec2> step(direction.size(), Vec2::Zero());
            add(step, factor, direction);
            memory_.remember(std::move(step), std::move(change));
            nodes_ = std::move(tried);
            value_ = there;
            gradient_ = std::move(gradient);
            last_step_ = factor * length;
            return true;
        }
    }
    return false;
}

bool PathDescent::iterate(const Progress& progress) {
    if (search(memory_.direction(gradient_), progress)) {
        return true;
    }
    if (memory_.empty()) {
        return false;
    }
    memory_.clear(); // what was remembered leads nowhere: once more along the gradient alone
    return search(memory_.direction(gradient_), progress);
}

} // namespace millwright::grid
