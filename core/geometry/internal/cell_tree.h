// Where the parts of a surface can be at all: each lies in the box of its control points (convex hull
// property; Farin, Curves and Surfaces for CAGD, ch. 4.3), which is tight where the part is small.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_refinement.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace millwright::geometry {

/// The boxes of the halves, quarters, ... of a surface, split in u and v in turn, as a full binary tree:
/// below `n` are 2n + 1 and 2n + 2.
class CellTree {
public:
    /// Of the surface that the pieces make.
    explicit CellTree(const std::vector<SurfacePiece>& pieces) : boxes_((std::size_t{2} << depth) - 1) {
        if (pieces.size() == 1) {
            build(0, 0, pieces.front().patch);
            return;
        }
        for (const SurfacePiece& piece : pieces) {
            add(0, 0, {}, piece);
        }
    }

    /// A part of the parameters.
    struct Cell {
        Vec2 low = Vec2::Zero();
        Vec2 high = Vec2::Ones();
    };

    /// Visits the cells whose boxes are nearer to `point` than `distance()`, which may become less on the
    /// way.
    template <class Distance, class Visit>
    void visit(const Vec3& point, const Distance& distance, const Visit& cell) const {
        visit(0, 0, {}, point, distance, cell);
    }

private:
    static constexpr int depth = 10;
    std::vector<Box3> boxes_;

    const Box3& build(std::size_t n, int level, const BezierPatch& patch) {
        if (level == depth) {
            boxes_[n] = patch.control_box();
            return boxes_[n];
        }
        const auto [first, second] = split(patch, level % 2 == 0 ? Parameter::u : Parameter::v, 0.5);
        boxes_[n] = build(2 * n + 1, level + 1, first);
        boxes_[n].extend(build(2 * n + 2, level + 1, second));
        return boxes_[n];
    }

    /// A piece that lies on both sides of a border between two cells is cut there.
    void add(std::size_t n, int level, const Cell& cell, const SurfacePiece& piece) {
        boxes_[n].extend(piece.patch.control_box());
        if (level == depth) {
            return;
        }
        constexpr double rounding = 1e-9; // of the piece; what lies so little beyond the border stays
        const int along = level % 2;
        const double middle = 0.5 * (cell.low[along] + cell.high[along]);
        const double at = (middle - piece.low[along]) / (piece.high[along] - piece.low[along]);
        const auto [before, behind] = halves(cell, along, middle);
        if (at <= rounding) {
            add(2 * n + 2, level + 1, behind, piece);
        } else if (at >= 1.0 - rounding) {
            add(2 * n + 1, level + 1, before, piece);
        } else {
            auto [first, second] = split(piece.patch, along == 0 ? Parameter::u : Parameter::v, at);
            SurfacePiece low{std::move(first), piece.low, piece.high};
            SurfacePiece high{std::move(second), piece.low, piece.high};
            low.high[along] = high.low[along] = middle;
            add(2 * n + 1, level + 1, before, low);
            add(2 * n + 2, level + 1, behind, high);
        }
    }

    static std::pair<Cell, Cell> halves(const Cell& cell, int along, double middle) {
        std::pair<Cell, Cell> result{cell, cell};
        result.first.high[along] = middle;
        result.second.low[along] = middle;
        return result;
    }

    template <class Distance, class Visit>
    void visit(std::size_t n,
               int level,
               const Cell& cell,
               const Vec3& point,
               const Distance& distance,
               const Visit& at_leaf) const {
        if (!(boxes_[n].squaredExteriorDistance(point) < distance() * distance())) {
            return;
        }
        if (level == depth) {
            at_leaf(cell);
            return;
        }
        const int along = level % 2;
        const double middle = 0.5 * (cell.low[along] + cell.high[along]);
        const auto [first, second] = halves(cell, along, middle);
        const std::size_t one = 2 * n + 1, other = 2 * n + 2;
        if (boxes_[other].squaredExteriorDistance(point) < boxes_[one].squaredExteriorDistance(point)) {
            visit(other, level + 1, second, point, distance, at_leaf);
            visit(one, level + 1, first, point, distance, at_leaf);
        } else {
            visit(one, level + 1, first, point, distance, at_leaf);
            visit(other, level + 1, second, point, distance, at_leaf);
        }
    }
};

} // namespace millwright::geometry
