#include "core/grid/jacobi_newton.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/internal/node_step.h"
#include "core/grid/internal/outline.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace millwright::grid {

namespace {

bool finite(const NodeEquations& e) {
    return std::isfinite(e.R_X) && std::isfinite(e.R_Y) && std::isfinite(e.R_XX) && std::isfinite(e.R_XY) &&
           std::isfinite(e.R_YY) && std::isfinite(e.J);
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
        equations_ = all_equations(nodes_, w, rules, std::move(equations_));
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
    ++iterations_;
    // An iteration may spread a folded start out, which is no answer to it.
    if (iterations_ == 1 && !(min_corner_jacobian(nodes_) > 0.0)) {
        status_ = SolverStatus::folded;
        return false;
    }
    const bool singular = relax(nodes_, equations_, settings_.boundary, settings_.relaxation) > 0;
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
    constexpr double sound = 2.0, inside_out = 1.0, not_finite = 0.0;
    const double worst = least_of_rows(nodes_.rows, nodes_.columns, [&](int i) {
        const std::span row =
            std::span(equations_).subspan(nodes_.index(i, 0), static_cast<std::size_t>(nodes_.columns));
        return !std::ranges::all_of(row, finite)                                             ? not_finite
               : std::ranges::any_of(row, [](const NodeEquations& e) { return e.J <= 0.0; }) ? inside_out
                                                                                             : sound;
    });
    if (!std::isfinite(norm_) || !(worst > not_finite)) {
        return SolverStatus::not_finite;
    }
    if (!(worst > inside_out) || min_cell_area(nodes_) <= 0.0 || min_corner_jacobian(nodes_) <= 0.0) {
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

/// The nodes, the same before an iteration and with their mirrored ring; the equations, anew beside the last
/// ones; the weight, with its ring.
std::size_t JacobiNewton::memory_bytes(int rows, int columns) {
    constexpr std::size_t a_node = 3 * sizeof(Vec2) + 2 * sizeof(NodeEquations) + 2 * sizeof(double);
    return (static_cast<std::size_t>(rows) + 2) * (static_cast<std::size_t>(columns) + 2) * a_node;
}

} // namespace millwright::grid
