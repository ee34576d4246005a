#include "core/grid/multigrid.h"

#include "core/base/error.h"
#include "core/grid/descent.h"
#include "core/grid/discrete_minimiser.h"
#include "core/grid/internal/level_stack.h"
#include "core/grid/internal/outline.h"
#include "core/grid/node_array.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

namespace millwright::grid {

// The best of what the last cycles of a multigrid method found, put together: the combination of their nodes
// whose residuals, were they linear, would be smallest. Source: Washio and Oosterlee, ETNA 6, 1997.

class Recombination {
public:
    [[nodiscard]] bool empty() const { return past_.empty(); }

    /// Nodes better than `nodes`, whose residuals are `residuals`; `nodes` themselves where what is
    /// remembered says nothing. They have not been checked for soundness yet.
    [[nodiscard]] NodeArray best(const NodeArray& nodes, const NodeArray& residuals) const;

    /// Nodes and what their residuals are.
    void remember(const NodeArray& nodes, const NodeArray& residuals);

    /// What is remembered at most, for each node.
    [[nodiscard]] static std::size_t bytes_per_node();

private:
    struct Found {
        std::vector<Vec2> nodes, residuals;
    };

    std::deque<Found> past_;
};

namespace {

constexpr std::size_t memory_length = 4;
constexpr double regularisation = 1e-12; // of the trace: residuals that depend on each other have no say

} // namespace

/// With r the residuals now and d_a = r_a - r those of the past: minimises |r + sum b_a d_a|^2.
NodeArray Recombination::best(const NodeArray& nodes, const NodeArray& residuals) const {
    const auto m = static_cast<Eigen::Index>(past_.size());
    std::vector<std::vector<Vec2>> d;
    for (const Found& found : past_) {
        d.push_back(found.residuals);
        add(d.back(), -1.0, residuals.nodes);
    }
    Eigen::MatrixXd normal(m, m);
    Eigen::VectorXd right(m);
    for (Eigen::Index a = 0; a < m; ++a) {
        const std::vector<Vec2>& d_a = d[static_cast<std::size_t>(a)];
        for (Eigen::Index b = 0; b <= a; ++b) {
            normal(a, b) = dot(d_a, d[static_cast<std::size_t>(b)]);
            normal(b, a) = normal(a, b);
        }
        right(a) = -dot(d_a, residuals.nodes);
    }
    const double trace = m > 0 ? normal.trace() : 0.0;
    if (!(trace > 0.0)) {
        return nodes;
    }
    normal.diagonal().array() += regularisation * trace;
    const Eigen::VectorXd share = normal.ldlt().solve(right);
    NodeArray combined = nodes;
    for (Eigen::Index a = 0; a < m; ++a) {
        std::vector<Vec2> way =
            past_[static_cast<std::size_t>(a)].nodes; // zero to the bit where nodes are fixed
        add(way, -1.0, nodes.nodes);
        add(combined.nodes, share(a), way);
    }
    return combined;
}

void Recombination::remember(const NodeArray& nodes, const NodeArray& residuals) {
    past_.push_back({nodes.nodes, residuals.nodes});
    if (past_.size() > memory_length) {
        past_.pop_front();
    }
}

std::size_t Recombination::bytes_per_node() {
    return ((memory_length + 1) * 2 + memory_length) * sizeof(Vec2);
}

namespace {

constexpr double progress_factor = 0.5; // of the norm counts as progress
constexpr int patience = 15;            // iterations without it: stalled

double squared(const NodeArray& residuals) {
    double sum = 0.0;
    for (const Vec2& r : residuals.nodes) {
        sum += r.squaredNorm();
    }
    return sum;
}

} // namespace

Multigrid::Multigrid(NodeArray start, WeightPtr weight, const EllipticSettings& settings)
    : past_(std::make_unique<Recombination>()), settings_(settings) {
    expects(start.rows >= 3 && start.columns >= 3, "a grid to solve for has at least 3 x 3 nodes");
    expects(all_finite(start), "a grid to solve for is finite");
    expects(weight != nullptr, "a solver has a weight");
    expects(settings.boundary == Boundary::fixed || is_axis_rectangle(start),
            "nodes slide only along the sides of a rectangle parallel to the axes");
    levels_ = std::make_unique<LevelStack>(std::move(start),
                                           std::move(weight),
                                           IndexDensity{},
                                           LevelRules{settings.functional, settings.boundary});
}

Multigrid::Multigrid(const Multigrid& other)
    : EllipticSolver(other), levels_(std::make_unique<LevelStack>(*other.levels_)),
      past_(std::make_unique<Recombination>(*other.past_)), settings_(other.settings_),
      status_(other.status_), iterations_(other.iterations_), norm_(other.norm_),
      best_norm_(other.best_norm_), last_progress_(other.last_progress_) {}

Multigrid::~Multigrid() = default;

std::unique_ptr<EllipticSolver> Multigrid::clone() const {
    return std::make_unique<Multigrid>(*this);
}

const NodeArray& Multigrid::nodes() const {
    return levels_->nodes();
}

bool Multigrid::iterate() {
    if (status_ != SolverStatus::running) {
        return false;
    }
    ++iterations_;
    status_ = one_cycle();
    return status_ == SolverStatus::running;
}

SolverStatus Multigrid::one_cycle() {
    if (iterations_ == 1) {
        if (!levels_->sound()) {
            return SolverStatus::folded;
        }
        norm_ = levels_->norm();
        if (!std::isfinite(norm_)) {
            return SolverStatus::not_finite;
        }
        if (norm_ <= settings_.tolerance) {
            return SolverStatus::converged;
        }
        levels_->come_up();
    }
    const NodeArray before = levels_->nodes();
    if (!levels_->cycle()) {
        return SolverStatus::not_finite;
    }
    if (!levels_->sound()) {
        levels_->nodes().nodes = before.nodes;
        norm_ = levels_->norm();
        return SolverStatus::stalled;
    }
    norm_ = levels_->norm();
    if (norm_ > settings_.tolerance) {
        recombine();
    }
    if (!std::isfinite(norm_)) {
        return SolverStatus::not_finite;
    }
    if (norm_ <= settings_.tolerance) {
        return SolverStatus::converged;
    }
    if (norm_ <= progress_factor * best_norm_) {
        best_norm_ = norm_;
        last_progress_ = iterations_;
    }
    if (iterations_ - last_progress_ >= patience) {
        return SolverStatus::stalled;
    }
    return iterations_ >= settings_.max_iterations ? SolverStatus::iteration_limit : SolverStatus::running;
}

/// Goes on from the combination of the last cycles where that is sound and its residuals are smaller.
void Multigrid::recombine() {
    if (past_->empty()) {
        past_->remember(levels_->nodes(), levels_->residuals());
        return;
    }
    const NodeArray found = levels_->nodes();
    const double before = squared(levels_->residuals());
    levels_->nodes() = past_->best(found, levels_->residuals());
    const double combined = levels_->sound() ? levels_->norm() : norm_at_start;
    if (levels_->sound() && std::isfinite(combined) && squared(levels_->residuals()) < before) {
        norm_ = combined;
    } else {
        levels_->nodes() = found;
        norm_ = levels_->norm();
    }
    past_->remember(levels_->nodes(), levels_->residuals());
}

std::size_t Multigrid::memory_bytes(int rows, int columns) {
    const auto nodes = static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    constexpr std::size_t copies = 3; // before a cycle, found by it, combined
    return LevelStack::memory_bytes(rows, columns) +
           nodes * (Recombination::bytes_per_node() + copies * sizeof(Vec2));
}

MultigridThenMinimiser::MultigridThenMinimiser(NodeArray start,
                                               WeightPtr weight,
                                               const EllipticSettings& settings)
    : weight_(weight), settings_(settings),
      solver_(std::make_unique<Multigrid>(std::move(start), std::move(weight), settings)) {}

MultigridThenMinimiser::MultigridThenMinimiser(const MultigridThenMinimiser& other,
                                               std::unique_ptr<EllipticSolver> solver)
    : EllipticSolver(other), weight_(other.weight_), settings_(other.settings_), solver_(std::move(solver)),
      last_norm_(other.last_norm_), iterations_before_(other.iterations_before_),
      fallen_back_(other.fallen_back_) {}

std::unique_ptr<EllipticSolver> MultigridThenMinimiser::clone() const {
    return std::unique_ptr<EllipticSolver>(new MultigridThenMinimiser(*this, solver_->clone()));
}

SolverStatus MultigridThenMinimiser::status() const {
    return solver_->status();
}

double MultigridThenMinimiser::norm() const {
    return solver_->iterations() > 0 ? solver_->norm() : last_norm_;
}

bool MultigridThenMinimiser::iterate() {
    solver_->iterate();
    const int left = settings_.max_iterations - iterations();
    if (!fallen_back_ && solver_->status() == SolverStatus::stalled && left > 0) {
        EllipticSettings rest = settings_;
        rest.max_iterations = left;
        last_norm_ = solver_->norm();
        iterations_before_ = solver_->iterations();
        solver_ = std::make_unique<DiscreteMinimiser>(solver_->nodes(), weight_, rest);
        fallen_back_ = true;
    }
    return solver_->status() == SolverStatus::running;
}

std::size_t MultigridThenMinimiser::memory_bytes(int rows, int columns) {
    return std::max(Multigrid::memory_bytes(rows, columns), DiscreteMinimiser::memory_bytes(rows, columns));
}

} // namespace millwright::grid
