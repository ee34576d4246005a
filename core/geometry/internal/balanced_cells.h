// Parts of a rational patch that are of nearly the same extent in space, however unevenly its weights spread
// the parameters: beside a control point whose weight is a millionth of a millionth of its neighbours', half
// of the surface may lie within 1e-12 of the parameters.
#pragma once

#include "core/geometry/bezier_patch.h"
#include "core/geometry/patch_refinement.h"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <utility>
#include <vector>

namespace millwright::geometry {

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
