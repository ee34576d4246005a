// Parts of a surface for a search over it: where they can be at all, and how a rational patch is cut into
// parts of nearly the same extent.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_refinement.h"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

namespace millwright::geometry {

// Where the parts of a surface can be at all: each lies in the box of its control points (convex hull
// property; Farin, Curves and Surfaces for CAGD, ch. 4.3), which is tight where the part is small.

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

// Parts of a rational patch that are of nearly the same extent in space, however unevenly its weights spread
// the parameters: beside a control point whose weight is a millionth of a millionth of its neighbours', half
// of the surface may lie within 1e-12 of the parameters.

/// A binary tree of parts, the largest being split first, across the direction in which its net is longer.
class BalancedCells {
public:
    /// A part with a net of its own over [0,1]^2: it is exact where the patch's own parameters are not.
    struct Part {
        Vec2 low = Vec2::Zero(); ///< parameters of the patch
        Vec2 high = Vec2::Ones();
        BezierPatch patch;

        /// The patch's parameters at a place of the part.
        [[nodiscard]] Vec2 at(const Vec2& within) const { return low + within.cwiseProduct(high - low); }
    };

    explicit BalancedCells(const BezierPatch& patch) {
        std::priority_queue<std::pair<double, std::size_t>> largest;
        const auto add = [&](Part part) {
            const Box3 box = part.patch.control_box();
            largest.emplace(box.diagonal().norm(), nodes_.size());
            nodes_.push_back({box, 0, parts_.size()});
            parts_.push_back(std::move(part));
        };
        add({Vec2::Zero(), Vec2::Ones(), patch});
        const std::size_t most = most_parts(patch.net());
        while (parts_.size() < most && largest.top().first > 0.0) {
            const std::size_t n = largest.top().second;
            largest.pop();
            auto [first, second] = halves(parts_[nodes_[n].part]);
            nodes_[n].children = nodes_.size();
            const std::size_t place = nodes_[n].part;
            largest.emplace(first.patch.control_box().diagonal().norm(), nodes_.size());
            nodes_.push_back({first.patch.control_box(), 0, place});
            parts_[place] = std::move(first);
            add(std::move(second));
        }
        for (std::size_t n = nodes_.size(); n-- > 0;) { // what is in both halves is in a smaller box
            if (nodes_[n].children > 0) {
                nodes_[n].box = nodes_[nodes_[n].children].box;
                nodes_[n].box.extend(nodes_[nodes_[n].children + 1].box);
            }
        }
    }

    /// Visits the parts whose boxes are nearer to `point` than `distance()`, which may become less on the
    /// way.
    template <class Distance, class Visit>
    void visit(const Vec3& point, const Distance& distance, const Visit& part, std::size_t n = 0) const {
        const Node& node = nodes_[n];
        if (!(node.box.squaredExteriorDistance(point) < distance() * distance())) {
            return;
        }
        if (node.children == 0) {
            part(parts_[node.part]);
            return;
        }
        const auto away = [&](std::size_t k) { return nodes_[k].box.squaredExteriorDistance(point); };
        const bool swapped = away(node.children + 1) < away(node.children);
        visit(point, distance, part, node.children + (swapped ? 1 : 0));
        visit(point, distance, part, node.children + (swapped ? 0 : 1));
    }

    /// Across the direction in which its net is longer.
    static std::pair<Part, Part> halves(const Part& part) {
        const int along =
            length_along(part.patch.net(), 1, 0) >= length_along(part.patch.net(), 0, 1) ? 0 : 1;
        auto [first, second] = split(part.patch, along == 0 ? Parameter::u : Parameter::v, 0.5);
        Part low{part.low, part.high, std::move(first)};
        Part high{part.low, part.high, std::move(second)};
        low.high[along] = high.low[along] = 0.5 * (part.low[along] + part.high[along]);
        return {std::move(low), std::move(high)};
    }

private:
    struct Node {
        Box3 box;
        std::size_t children = 0; ///< the first of two that follow each other; 0: it is a part
        std::size_t part = 0;
    };
    std::vector<Node> nodes_;
    std::vector<Part> parts_;

    /// So that they need some tens of MB at most.
    static std::size_t most_parts(const ControlNet& net) {
        constexpr std::size_t points = 250'000, least = 64, most = 2048;
        return std::clamp(points / net.points.size(), least, most);
    }

    /// The longest row (`step_i` 0) or column of the net, mm.
    static double length_along(const ControlNet& net, int step_i, int step_j) {
        double longest = 0.0;
        const int lines = step_i > 0 ? net.columns : net.rows;
        const int count = step_i > 0 ? net.rows : net.columns;
        for (int line = 0; line < lines; ++line) {
            double length = 0.0;
            for (int n = 1; n < count; ++n) {
                const int i = step_i > 0 ? n : line, j = step_i > 0 ? line : n;
                length += (net.point(i, j) - net.point(i - step_i, j - step_j)).norm();
            }
            longest = std::max(longest, length);
        }
        return longest;
    }
};

} // namespace millwright::geometry
