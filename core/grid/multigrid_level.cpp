#include "core/grid/internal/multigrid_level.h"

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

constexpr double longest_node_step =
    0.3; // of the side of a mean cell: farther, and neighbours may pass each other
constexpr double most_change = 10.0; // of a restricted weight by its slope, up or down: it keeps its sign

/// The four corner triangles of a cell are positive.
bool sound_cell(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
    const Vec2 ab = b - a;
    const Vec2 bc = c - b;
    const Vec2 cd = d - c;
    const Vec2 da = a - d;
    return cross(ab, bc) > 0.0 && cross(bc, cd) > 0.0 && cross(cd, da) > 0.0 && cross(da, ab) > 0.0;
}

double sloped(double w, double change) {
    const double one = w / most_change;
    const double other = w * most_change;
    return std::clamp(w + change, std::min(one, other), std::max(one, other));
}

Vec2 slope_of_weight(const NodeStencil& s) {
    const Vec2 xi = s.p[2][1] - s.p[0][1];
    const Vec2 eta = s.p[1][2] - s.p[1][0];
    const double J = cross(xi, eta);
    if (!(J > 0.0)) {
        return Vec2::Zero();
    }
    const double w_xi = s.w_after - s.w_before;
    const double w_eta = s.w_above - s.w_below;
    return Vec2(w_xi * eta.y() - w_eta * xi.y(), xi.x() * w_eta - eta.x() * w_xi) / J;
}

} // namespace

MultigridLevel::MultigridLevel(
    int rows, int columns, const IndexDensity& density, const LevelRules& rules, WeightPtr weight)
    : nodes(rows, columns), w(nodes.nodes.size()), density_(density), rules_(rules),
      weight_(std::move(weight)) {
    expects(rows >= 3 && columns >= 3, "a level has at least 3 x 3 nodes");
    if (weight_ == nullptr) {
        right_side = nodes;
        begun_ = nodes;
        w_begun_ = w;
        slope_ = nodes.nodes;
    }
}

bool MultigridLevel::moves(int i, int j) const {
    return !freedom(nodes, i, j, rules_.boundary == Boundary::sliding).isZero();
}

void MultigridLevel::begin() {
    std::ranges::copy(nodes.nodes, begun_.nodes.begin());
    std::ranges::copy(w, w_begun_.begin());
    for_rows(
        rows(),
        columns(),
        [this](int i) {
            for (int j = 0; j < columns(); ++j) {
                if (moves(i, j)) {
                    slope_[nodes.index(i, j)] = slope_of_weight(stencil(i, j));
                }
            }
        },
        light_nodes_worth_a_thread);
}

bool MultigridLevel::ask_weight() {
    for_pieces(w.size(), [this](std::size_t first, std::size_t count) {
        if (weight_ != nullptr) {
            weight_->values(std::span(nodes.nodes).subspan(first, count), std::span(w).subspan(first, count));
            return;
        }
        for (std::size_t k = first; k < first + count; ++k) {
            w[k] = sloped(w_begun_[k], slope_[k].dot(nodes.nodes[k] - begun_.nodes[k]));
        }
    });
    return std::ranges::all_of(w, [](double value) { return std::isfinite(value); });
}

/// Beyond a side along which nodes slide lies its mirror image.
NodeStencil MultigridLevel::stencil(int i, int j) const {
    NodeStencil s;
    const bool inside = i > 0 && j > 0 && i + 1 < rows() && j + 1 < columns();
    const auto row = [&](int a) { return inside ? i + a - 1 : mirrored_index(i + a - 1, rows()); };
    const auto column = [&](int b) { return inside ? j + b - 1 : mirrored_index(j + b - 1, columns()); };
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            Vec2& p = s.p[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)];
            p = nodes.at(row(a), column(b));
            if (!inside && row(a) != i + a - 1) {
                p.x() = 2.0 * nodes.at(i, j).x() - p.x();
            }
            if (!inside && column(b) != j + b - 1) {
                p.y() = 2.0 * nodes.at(i, j).y() - p.y();
            }
        }
    }
    s.w = w[nodes.index(i, j)];
    s.w_before = w[nodes.index(row(0), j)];
    s.w_after = w[nodes.index(row(2), j)];
    s.w_below = w[nodes.index(i, column(0))];
    s.w_above = w[nodes.index(i, column(2))];
    return s;
}

NodeEquations MultigridLevel::equations(int i, int j) const {
    NodeEquations e = node_equations(stencil(i, j), rules_.functional, density_);
    if (!right_side.nodes.empty()) {
        const Vec2& f = right_side.at(i, j);
        e.R_X -= f.x();
        e.R_Y -= f.y();
    }
    return e;
}

void MultigridLevel::smooth_node(int i, int j) {
    const NodeEquations e = equations(i, j);
    if (!(e.J > 0.0)) { // nonsense on a coarse level; the correction that comes of it will be judged
        return;
    }
    const Vec2 step = displacement(nodes, e, i, j, rules_.boundary, 1.0).step;
    const double length2 = step.squaredNorm();
    const double most2 = square(longest_node_step / std::max(density_.xi, density_.eta)) * e.J;
    if (std::isfinite(length2)) {
        nodes.at(i, j) += length2 > most2 ? Vec2(std::sqrt(most2 / length2) * step) : step;
    }
}

bool MultigridLevel::smooth() {
    if (!ask_weight()) {
        return false;
    }
    const int rim = rules_.boundary == Boundary::fixed ? 1 : 0;
    for (int colour = 0; colour < 4; ++colour) {
        const int first_row = rim + colour / 2;
        const int first_column = rim + colour % 2;
        const int count = (rows() - rim - first_row + 1) / 2;
        for_rows(
            count,
            columns() / 2,
            [&](int k) {
                const int i = first_row + 2 * k;
                for (int j = first_column; j + rim < columns(); j += 2) {
                    smooth_node(i, j);
                }
            },
            light_nodes_worth_a_thread);
    }
    return true;
}

void MultigridLevel::residual(NodeArray& found) const {
    const bool sliding = rules_.boundary == Boundary::sliding;
    for_rows(
        rows(),
        columns(),
        [&](int i) {
            for (int j = 0; j < columns(); ++j) {
                const Vec2 free = freedom(nodes, i, j, sliding);
                if (free.isZero()) {
                    found.at(i, j).setZero();
                    continue;
                }
                const NodeEquations e = equations(i, j);
                found.at(i, j) = -free.cwiseProduct(Vec2(e.R_X, e.R_Y));
            }
        },
        light_nodes_worth_a_thread);
}

bool MultigridLevel::sound() const {
    std::vector<char> folded(static_cast<std::size_t>(rows()), 0);
    for_rows(
        rows() - 1,
        columns(),
        [&](int i) {
            for (int j = 0; j + 1 < columns(); ++j) {
                if (!sound_cell(
                        nodes.at(i, j), nodes.at(i + 1, j), nodes.at(i + 1, j + 1), nodes.at(i, j + 1))) {
                    folded[static_cast<std::size_t>(i)] = 1;
                    return;
                }
            }
        },
        light_nodes_worth_a_thread);
    return std::ranges::none_of(folded, [](char here) { return here != 0; });
}

} // namespace millwright::grid
