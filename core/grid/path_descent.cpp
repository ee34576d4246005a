#include "core/grid/path_descent.h"

#include "core/base/error.h"
#include "core/grid/curved_tracks.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double longest_descent_step = 0.3; // cells, for one node in one iteration
constexpr double descent_decrease = 1e-4;    // Armijo
constexpr int most_descent_halvings = 20;

// Of a leap. Wider rasters or one sweep more cost more than they bring.
constexpr int sweeps = 5;
constexpr double furthest_place = 0.3; // cells, of the first sweep
constexpr double narrowing = 0.6;      // from sweep to sweep
constexpr double least_gain = 1e-3;    // of the objective

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
    double factor = std::min(1.0, longest_descent_step / length);
    for (int halving = 0; halving < most_descent_halvings; ++halving, factor /= 2.0) {
        NodeArray tried = objective_.moved(nodes_, factor, direction);
        const PathCost there = objective_.cost(tried, progress);
        if (there.sum <= value_ + descent_decrease * factor * slope) {
            std::vector<Vec2> gradient = objective_.gradient(tried, there, progress);
            std::vector<Vec2> change = gradient;
            add(change, -1.0, gradient_);
            std::vector<Vec2> step(direction.size(), Vec2::Zero());
            add(step, factor, direction);
            memory_.remember(std::move(step), std::move(change));
            nodes_ = std::move(tried);
            value_ = there.sum;
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

bool PathDescent::leap(const Progress& progress) {
    NodeArray found = nodes_;
    double reach = furthest_place;
    for (int sweep = 0; sweep < sweeps; ++sweep, reach *= narrowing) {
        const Progress part = progress.part(static_cast<double>(sweep) / sweeps, (sweep + 1.0) / sweeps);
        found = shortest_curved_tracks(objective_, std::move(found), {.reach = reach}, part);
    }
    const PathCost there = objective_.cost(found, progress);
    if (!(there.sum < (1.0 - least_gain) * value_)) {
        return false;
    }
    gradient_ = objective_.gradient(found, there, progress);
    nodes_ = std::move(found);
    value_ = there.sum;
    memory_.clear(); // of another valley
    return true;
}

} // namespace millwright::grid
