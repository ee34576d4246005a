#include "core/grid/internal/node_step.h"

#include "core/base/numbers.h"
#include "core/grid/internal/outline.h"

#include <algorithm>
#include <cmath>

namespace millwright::grid {

namespace {

constexpr double smallest_determinant = 1e-14; // against the entries: below, the 2 x 2 system is singular
constexpr double share_of_gap = 0.4;           // less than half, so that two neighbours cannot meet

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

} // namespace

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

} // namespace millwright::grid
