#include "core/grid/jacobi_newton.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/internal/outline.h"
#include "core/grid/internal/rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::grid {

namespace {

constexpr double smallest_determinant = 1e-14; // against the entries: below, the 2 x 2 system is singular
constexpr double share_of_gap = 0.4;           // less than half, so that two neighbours cannot meet

bool finite(const NodeEquations& e) {
    return std::isfinite(e.R_X) && std::isfinite(e.R_Y) && std::isfinite(e.R_XX) && std::isfinite(e.R_XY) &&
           std::isfinite(e.R_YY) && std::isfinite(e.J);
}

struct Displacement {
    Vec2 step = Vec2::Zero();
    bool singular = false;
};

/// Cramer's rule; no displacement where the system has no solution.
Displacement newton_step(const NodeEquations& e) {
    const double D = e.R_XX * e.R_YY - e.R_XY * e.R_XY;
    const double size = square(e.R_XX) + 2.0 * square(e.R_XY) + square(e.R_YY);
    if (!(std::abs(D) > smallest_determinant * size)) {
        return {.step = Vec2::Zero(), .singular = true};
    }
    return {.step = Vec2(e.R_XY * e.R_Y - e.R_YY * e.R_X, e.R_XY * e.R_X - e.R_XX * e.R_Y) / D};
}

/// On a side only the tangential equation counts.
Displacement tangential_step(const NodeEquations& e, const Vec2& freedom) {
    const double R = freedom.x() * e.R_X + freedom.y() * e.R_Y;
    const double R_own = freedom.x() * e.R_XX + freedom.y() * e.R_YY;
    if (!(std::abs(R_own) > 0.0)) {
        return {.step = Vec2::Zero(), .singular = true};
    }
    return {.step = -R / R_own * freedom};
}

/// `step` cut so that node `at` keeps its place between `before` and `after` on their side.
Vec2 in_order(const Vec2& step, const Vec2& before, const Vec2& at, const Vec2& after) {
    const Vec2 along = step.norm() > 0.0 ? Vec2(step.normalized()) : Vec2(Vec2::Zero());
    const double room = share_of_gap * std::max((after - at).dot(along), (before - at).dot(along));
    return std::min(step.norm(), room) * along;
}

Displacement
displacement(const NodeArray& nodes, const NodeEquations& e, int i, int j, Boundary boundary, double share) {
    const Vec2 free = freedom(nodes, i, j, boundary == Boundary::sliding);
    if (free.isZero()) {
        return {};
    }
    if (free.sum() > 1.5) { // both ways: an interior node
        Displacement inside = newton_step(e);
        inside.step *= share;
        return inside;
    }
    Displacement side = tangential_step(e, free);
    const bool along_rows = free.x() > 0.5;
    side.step = in_order(share * side.step,
                         along_rows ? nodes.at(i - 1, j) : nodes.at(i, j - 1),
                         nodes.at(i, j),
                         along_rows ? nodes.at(i + 1, j) : nodes.at(i, j + 1));
    return side;
}

} // namespace

int relax(NodeArray& nodes,
          const std::vector<NodeEquations>& equations,
          Boundary boundary,
          double relaxation) {
    const NodeArray old = nodes;
    std::vector<int> singular(static_cast<std::size_t>(nodes.rows), 0);
    for_rows(nodes.rows, nodes.columns, [&](int i) {
        for (int j = 0; j < nodes.columns; ++j) {
            const Displacement d =
                displacement(old, equations[old.index(i, j)], i, j, boundary, 1.0 - relaxation);
            nodes.at(i, j) += d.step;
            singular[static_cast<std::size_t>(i)] += d.singular ? 1 : 0;
        }
    });
    int count = 0;
    for (const int in_row : singular) {
        count += in_row;
    }
    return count;
}

JacobiNewton::JacobiNewton(NodeArray start, WeightPtr weight, const EllipticSettings& settings)
    : nodes_(std::move(start)), weight_(std::move(weight)), settings_(settings) {
    expects(nodes_.rows >= 3 && nodes_.columns >= 3, "a grid to solve for has at least 3 x 3 nodes");
    expects(all_finite(nodes_), "a grid to solve for is finite");
    expects(weight_ != nullptr, "a solver has a weight");
    expects(settings_.boundary == Boundary::fixed || is_axis_rectangle(nodes_),
            "nodes slide only along the sides of a rectangle parallel to the axes");
    sweep();
}

std::unique_ptr<EllipticSolver> JacobiNewton::clone() const {
    return std::make_unique<JacobiNewton>(*this);
}

void JacobiNewton::sweep() {
    const std::vector<double> w = weight_at_nodes(*weight_, nodes_);
    if (!std::ranges::all_of(w, [](double value) { return std::isfinite(value); })) {
        status_ = SolverStatus::not_finite;
        return;
    }
    const EquationRules rules{settings_.functional, settings_.derivatives};
    if (settings_.boundary == Boundary::fixed) {
        equations_ = all_equations(nodes_, w, rules);
        return;
    }
    const NodeArray wider = with_mirrored_ring(nodes_);
    const auto found = all_equations(wider, with_mirrored_ring(w, nodes_.rows, nodes_.columns), rules);
    equations_.resize(nodes_.nodes.size());
    for (int i = 0; i < nodes_.rows; ++i) {
        for (int j = 0; j < nodes_.columns; ++j) {
            NodeEquations e = found[wider.index(i + 1, j + 1)];
            const Vec2 free = freedom(nodes_, i, j, true);
            e.R_X *= free.x();
            e.R_Y *= free.y();
            equations_[nodes_.index(i, j)] = e;
        }
    }
}

bool JacobiNewton::iterate() {
    if (status_ != SolverStatus::running) {
        return false;
    }
    const bool singular = relax(nodes_, equations_, settings_.boundary, settings_.relaxation) > 0;
    ++iterations_;
    if (all_finite(nodes_)) {
        sweep();
    } else {
        status_ = SolverStatus::not_finite;
    }
    if (status_ == SolverStatus::running) {
        norm_ = residual_norm(equations_);
        status_ = judge(singular);
    }
    return status_ == SolverStatus::running;
}

SolverStatus JacobiNewton::judge(bool singular) const {
    if (!std::isfinite(norm_) || !std::ranges::all_of(equations_, finite)) {
        return SolverStatus::not_finite;
    }
    const bool inside_out =
        std::ranges::any_of(equations_, [](const NodeEquations& e) { return e.J <= 0.0; });
    if (inside_out || min_cell_area(nodes_) <= 0.0 || min_corner_jacobian(nodes_) <= 0.0) {
        return SolverStatus::folded;
    }
    if (singular) {
        return SolverStatus::singular;
    }
    if (norm_ <= settings_.tolerance) {
        return SolverStatus::converged;
    }
    return iterations_ >= settings_.max_iterations ? SolverStatus::iteration_limit : SolverStatus::running;
}

} // namespace millwright::grid
