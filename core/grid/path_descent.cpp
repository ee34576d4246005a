#include "core/grid/path_descent.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/grid/curved_tracks.h"
#include "core/grid/internal/outline.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double difference = 1e-6; // cells: bends and rounding both stay below 1e-3 of a slope

} // namespace

/// An array with one node elsewhere, or two.
class PathObjective::Around {
public:
    struct Moved {
        std::size_t node;
        Vec2 place;
    };

    Around(const NodeArray& nodes, const Moved& moved) : Around(nodes, moved, moved) {}
    Around(const NodeArray& nodes, const Moved& one, const Moved& other)
        : nodes_(nodes), one_(one), other_(other) {}

    [[nodiscard]] const Vec2& at(int i, int j) const {
        const std::size_t n = nodes_.index(i, j);
        return n == one_.node ? one_.place : n == other_.node ? other_.place : nodes_.nodes[n];
    }

private:
    const NodeArray& nodes_;
    Moved one_, other_;
};

PathObjective::PathObjective(const ErrorModel& model,
                             TrackDirection direction,
                             const NodeArray& outline,
                             const PathObjectiveSettings& settings)
    : model_(&model), direction_(direction), rows_(outline.rows), columns_(outline.columns),
      cell_((outline.at(rows_ - 1, columns_ - 1) - outline.at(0, 0))
                .cwiseQuotient(Vec2(rows_ - 1, columns_ - 1))),
      settings_(settings) {
    expects(is_axis_rectangle(outline), "nodes slide only along a rectangle parallel to the axes");
    expects(cell_.x() > 0.0 && cell_.y() > 0.0, "the outline has an area");
    expects(settings.unit_cost > 0.0, "the unit of the cost is positive");
}

double PathObjective::move_cost(const Vec2& from, const Vec2& to) const {
    return settings_.cost(model_->move(from, to, settings_.sampling)) / settings_.unit_cost;
}

double PathObjective::gap_cost(const Vec2& from, const Vec2& to) const {
    const double gap = direction_ == TrackDirection::along_v ? (to.x() - from.x()) / cell_.x()
                                                             : (to.y() - from.y()) / cell_.y();
    const double over = std::max(0.0, gap - settings_.widest_gap) / settings_.gap_softness;
    const double under = std::max(0.0, settings_.narrowest_gap - gap) / settings_.gap_softness;
    return square(over) + square(under);
}

/// Of the cell whose first node is (i, j).
template <class Nodes> double PathObjective::corners_of_cell(const Nodes& nodes, int i, int j) const {
    double sum = 0.0;
    for (const int corner : {0, 1, 2, 3}) {
        const int row = i + corner % 2;
        const int column = j + corner / 2;
        const Vec2 xi = (nodes.at(i + 1, column) - nodes.at(i, column)).cwiseQuotient(cell_);
        const Vec2 eta = (nodes.at(row, j + 1) - nodes.at(row, j)).cwiseQuotient(cell_);
        const double room = xi.x() * eta.y() - xi.y() * eta.x() - settings_.least_jacobian;
        if (!(room > 0.0)) {
            return infinity;
        }
        sum += (xi.squaredNorm() + eta.squaredNorm()) / room;
    }
    return settings_.corner_weight * sum;
}

/// All that depends on node (i, j); `cost(i, j, from, to)` is that of the move that begins at node (i, j).
template <class Nodes, class Cost>
double PathObjective::at_node(const Nodes& nodes, int i, int j, const Cost& cost) const {
    double sum = 0.0;
    for (const int row : {i - 1, i}) {
        for (const int column : {j - 1, j}) {
            if (row >= 0 && column >= 0 && row + 1 < rows_ && column + 1 < columns_) {
                sum += corners_of_cell(nodes, row, column);
            }
        }
    }
    if (!(sum < infinity)) {
        return infinity;
    }
    const bool rows_are_tracks = direction_ == TrackDirection::along_v;
    for (const int row : {i - 1, i}) {
        if (row >= 0 && row + 1 < rows_) {
            const Vec2& from = nodes.at(row, j);
            const Vec2& to = nodes.at(row + 1, j);
            sum += rows_are_tracks ? gap_cost(from, to) : cost(row, j, from, to);
        }
    }
    for (const int column : {j - 1, j}) {
        if (column >= 0 && column + 1 < columns_) {
            const Vec2& from = nodes.at(i, column);
            const Vec2& to = nodes.at(i, column + 1);
            sum += rows_are_tracks ? cost(i, column, from, to) : gap_cost(from, to);
        }
    }
    return sum;
}

double PathObjective::of_move(
    const NodeArray& nodes, int track, int k, const Vec2& from, const Vec2& to, double most) const {
    const bool rows_are_tracks = direction_ == TrackDirection::along_v;
    const auto index = [&](int t, int n) { return rows_are_tracks ? nodes.index(t, n) : nodes.index(n, t); };
    const Around moved(nodes, {index(track, k), from}, {index(track, k + 1), to});
    const int tracks = rows_are_tracks ? rows_ : columns_;
    double sum = 0.0;
    for (const int side : {track - 1, track}) {
        if (side >= 0 && side + 1 < tracks) {
            sum += rows_are_tracks ? corners_of_cell(moved, side, k) : corners_of_cell(moved, k, side);
        }
    }
    return sum < most ? sum + move_cost(from, to) : infinity;
}

double PathObjective::of_gaps(const NodeArray& nodes, int track, int k, const Vec2& place) const {
    const bool rows_are_tracks = direction_ == TrackDirection::along_v;
    const auto node = [&](int t) { return rows_are_tracks ? nodes.at(t, k) : nodes.at(k, t); };
    const int tracks = rows_are_tracks ? rows_ : columns_;
    const double before = track > 0 ? gap_cost(node(track - 1), place) : 0.0;
    return before + (track + 1 < tracks ? gap_cost(place, node(track + 1)) : 0.0);
}

PathCost PathObjective::cost(const NodeArray& nodes, const Progress& progress) const {
    const bool rows_are_tracks = direction_ == TrackDirection::along_v;
    PathCost cost{0.0, std::vector<double>(nodes.nodes.size(), 0.0)};
    std::vector<double> sums(static_cast<std::size_t>(rows_), 0.0);
    parallel_for(rows_, 1, [&](std::ptrdiff_t row) {
        progress.check();
        const int i = static_cast<int>(row);
        double& sum = sums[static_cast<std::size_t>(row)];
        for (int j = 0; j + 1 < columns_ && i + 1 < rows_; ++j) {
            sum += corners_of_cell(nodes, i, j);
        }
        if (!(sum < infinity)) {
            return;
        }
        for (int j = 0; j < columns_; ++j) {
            const Vec2& here = nodes.at(i, j);
            double& move = cost.moves[nodes.index(i, j)];
            if (i + 1 < rows_) {
                const Vec2& next = nodes.at(i + 1, j);
                move = rows_are_tracks ? move : move_cost(here, next);
                sum += rows_are_tracks ? gap_cost(here, next) : move;
            }
            if (j + 1 < columns_) {
                const Vec2& next = nodes.at(i, j + 1);
                move = rows_are_tracks ? move_cost(here, next) : move;
                sum += rows_are_tracks ? move : gap_cost(here, next);
            }
        }
    });
    cost.sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    return cost;
}

double PathObjective::value(const NodeArray& nodes, const Progress& progress) const {
    return cost(nodes, progress).sum;
}

/// To the other side where a node `difference` further is out of reach; `now` is at_node().
double PathObjective::slope(const NodeArray& nodes, int i, int j, int coordinate, double now) const {
    const auto cost = [this](int, int, const Vec2& from, const Vec2& to) { return move_cost(from, to); };
    for (const double way : {difference, -difference}) {
        Vec2 there = nodes.at(i, j);
        there[coordinate] += way * cell_[coordinate];
        const double then = at_node(Around(nodes, {nodes.index(i, j), there}), i, j, cost);
        if (then < infinity) {
            return (then - now) / way;
        }
    }
    return 0.0;
}

std::vector<Vec2> PathObjective::gradient(const NodeArray& nodes, const Progress& progress) const {
    return gradient(nodes, cost(nodes, progress), progress);
}

std::vector<Vec2>
PathObjective::gradient(const NodeArray& nodes, const PathCost& cost, const Progress& progress) const {
    expects(cost.sum < infinity, "a gradient is taken where the objective is finite");
    const auto known = [&](int i, int j, const Vec2&, const Vec2&) { return cost.moves[nodes.index(i, j)]; };
    std::vector<Vec2> found(nodes.nodes.size(), Vec2::Zero());
    parallel_for(rows_, 1, [&](std::ptrdiff_t row) {
        progress.check();
        const int i = static_cast<int>(row);
        for (int j = 0; j < columns_; ++j) {
            const Vec2 free = freedom(nodes, i, j, true);
            const double now = at_node(nodes, i, j, known);
            for (const int coordinate : {0, 1}) {
                if (free[coordinate] > 0.0) {
                    found[nodes.index(i, j)][coordinate] = slope(nodes, i, j, coordinate, now);
                }
            }
        }
    });
    return found;
}

NodeArray PathObjective::moved(const NodeArray& nodes, double factor, const std::vector<Vec2>& steps) const {
    NodeArray found = nodes;
    for (std::size_t n = 0; n < steps.size(); ++n) {
        const Vec2 place = nodes.nodes[n] + factor * steps[n].cwiseProduct(cell_);
        found.nodes[n] = place.cwiseMax(0.0).cwiseMin(1.0);
    }
    return found;
}

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
