#include "core/grid/discrete_minimiser.h"

#include "core/base/error.h"
#include "core/grid/corner_functionals.h"
#include "core/grid/internal/outline.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double longest_minimiser_step = 0.3; // of a uniform cell, for one node in one iteration
constexpr double minimiser_decrease = 1e-4;    // Armijo
constexpr int most_minimiser_halvings = 40;

double norm_of(const NodeArray& gradient) {
    double largest = 0.0;
    for (const Vec2& g : gradient.nodes) {
        largest = std::max(largest, (std::abs(g.x()) + std::abs(g.y())) / 4.0);
    }
    return largest;
}

GridFunctional volume_functional(WeightPtr weight, const FunctionalWeights& lambda) {
    expects(weight != nullptr, "a solver has a weight");
    return [weight = std::move(weight), lambda](const NodeArray& nodes) {
        return discrete_functional(nodes, *weight, lambda);
    };
}

} // namespace

DiscreteMinimiser::DiscreteMinimiser(NodeArray start, WeightPtr weight, const EllipticSettings& settings)
    : DiscreteMinimiser(
          std::move(start), volume_functional(std::move(weight), settings.functional), settings) {}

DiscreteMinimiser::DiscreteMinimiser(NodeArray start,
                                     GridFunctional functional,
                                     const EllipticSettings& settings)
    : nodes_(std::move(start)), functional_(std::move(functional)), settings_(settings) {
    expects(nodes_.rows >= 2 && nodes_.columns >= 2, "a grid to solve for has at least 2 x 2 nodes");
    expects(all_finite(nodes_), "a grid to solve for is finite");
    expects(functional_ != nullptr, "a minimiser has a functional");
    expects(settings_.boundary == Boundary::fixed || is_axis_rectangle(nodes_),
            "nodes slide only along the sides of a rectangle parallel to the axes");
    if (!(min_corner_jacobian(nodes_) > 0.0)) {
        status_ = SolverStatus::folded;
        return;
    }
    now_ = evaluate(nodes_);
    status_ = std::isfinite(now_.value) ? SolverStatus::running : SolverStatus::not_finite;
}

std::unique_ptr<EllipticSolver> DiscreteMinimiser::clone() const {
    return std::make_unique<DiscreteMinimiser>(*this);
}

/// The gradient along what may move.
DiscreteFunctional DiscreteMinimiser::evaluate(const NodeArray& nodes) const {
    DiscreteFunctional found = functional_(nodes);
    for (int i = 0; i < found.gradient.rows; ++i) {
        for (int j = 0; j < found.gradient.columns; ++j) {
            Vec2& g = found.gradient.at(i, j);
            g = g.cwiseProduct(freedom(nodes, i, j, settings_.boundary == Boundary::sliding)).eval();
        }
    }
    return found;
}

/// Takes the longest of the halved steps that decreases the functional enough; false if none does.
bool DiscreteMinimiser::search(const std::vector<Vec2>& direction) {
    const double slope = dot(now_.gradient.nodes, direction);
    const double length = longest(direction);
    if (!(slope < 0.0) || !(length > 0.0)) {
        return false;
    }
    double factor = std::min(1.0, longest_minimiser_step / length);
    for (int halving = 0; halving < most_minimiser_halvings; ++halving, factor /= 2.0) {
        NodeArray tried = nodes_;
        add(tried.nodes, factor, direction);
        DiscreteFunctional there = evaluate(tried);
        if (there.value <= now_.value + minimiser_decrease * factor * slope) {
            std::swap(nodes_, tried);
            std::swap(now_, there);
            remember(tried, there);
            return true;
        }
    }
    return false;
}

void DiscreteMinimiser::remember(const NodeArray& old_nodes, const DiscreteFunctional& old) {
    std::vector<Vec2> step = nodes_.nodes;
    std::vector<Vec2> change = now_.gradient.nodes;
    add(step, -1.0, old_nodes.nodes);
    add(change, -1.0, old.gradient.nodes);
    memory_.remember(std::move(step), std::move(change));
}

bool DiscreteMinimiser::iterate() {
    if (status_ != SolverStatus::running) {
        return false;
    }
    const bool gradient_alone = memory_.empty();
    const bool moved = search(memory_.direction(now_.gradient.nodes));
    ++iterations_;
    norm_ = norm_of(now_.gradient);
    if (norm_ <= settings_.tolerance) {
        status_ = SolverStatus::converged;
    } else if (!moved && gradient_alone) {
        status_ = SolverStatus::stalled;
    } else if (iterations_ >= settings_.max_iterations) {
        status_ = SolverStatus::iteration_limit;
    }
    if (!moved) {
        memory_.clear();
    }
    return status_ == SolverStatus::running;
}

/// Two grids with their gradients, a direction, a step with its change and what L-BFGS remembers; while the
/// functional is summed up the terms of every cell and the weight with its slope.
std::size_t DiscreteMinimiser::memory_bytes(int rows, int columns) {
    constexpr std::size_t arrays = 7 + 2 * DescentMemory::length;
    constexpr std::size_t a_node =
        arrays * sizeof(Vec2) + sizeof(internal::CellTerms) + sizeof(double) + sizeof(Vec2);
    return static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) * a_node;
}

} // namespace millwright::grid
