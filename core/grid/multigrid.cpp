#include "core/grid/multigrid.h"

#include "core/base/error.h"
#include "core/grid/internal/level_stack.h"
#include "core/grid/internal/outline.h"
#include "core/grid/internal/recombination.h"

#include <cmath>
#include <utility>

namespace millwright::grid {

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

} // namespace millwright::grid
