#include "core/plot/carving/internal/axis_trails.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace millwright::plot::internal {
namespace {

/// Takes edges away from the axis, trail by trail.
class TrailWalk {
public:
    explicit TrailWalk(const MedialAxis& axis)
        : axis_(axis), edges_at_(axis.nodes.size()), used_(axis.edges.size()) {
        for (std::size_t n = 0; n < axis.edges.size(); ++n) {
            at(axis.edges[n].from).push_back(n);
            at(axis.edges[n].to).push_back(n);
        }
    }

    std::vector<AxisTrail> run() {
        const int nodes = static_cast<int>(axis_.nodes.size());
        for (int n = 0; n < nodes; ++n) {
            if (at(n).empty()) {
                const AxisNode& node = axis_.nodes[static_cast<std::size_t>(n)];
                trails_.push_back({node.part, {Vec3(node.at.x(), node.at.y(), node.clearance)}});
            }
        }
        // A node with an odd number of edges is the end of a trail; what is left then are closed ways.
        for (const bool odd_only : {true, false}) {
            for (int n = 0; n < nodes; ++n) {
                while (left_at(n) > 0 && (!odd_only || left_at(n) % 2 == 1)) {
                    walk(n);
                }
            }
        }
        return std::move(trails_);
    }

private:
    std::vector<std::size_t>& at(int node) { return edges_at_[static_cast<std::size_t>(node)]; }
    std::size_t left_at(int node) {
        std::erase_if(at(node), [&](std::size_t n) { return used_[n]; });
        return at(node).size();
    }

    [[nodiscard]] std::vector<Vec3> way_from(std::size_t edge, int node) const {
        std::vector<Vec3> way = axis_.edges[edge].way;
        if (axis_.edges[edge].from != node) {
            std::ranges::reverse(way);
        }
        return way;
    }

    /// The edge that goes on straightest; the first at the beginning of a trail.
    std::size_t next_edge(int node, const std::vector<Vec3>& way) {
        std::size_t best = at(node).front();
        if (way.size() < 2) {
            return best;
        }
        const Vec2 before = (way.back() - way[way.size() - 2]).head<2>();
        double straightest = -std::numeric_limits<double>::infinity();
        for (const std::size_t n : at(node)) {
            const std::vector<Vec3> on = way_from(n, node);
            const Vec2 behind = (on[1] - on[0]).head<2>();
            const double length = before.norm() * behind.norm();
            const double straight = length > 0.0 ? before.dot(behind) / length : 0.0;
            if (straight > straightest) {
                straightest = straight;
                best = n;
            }
        }
        return best;
    }

    void walk(int node) {
        AxisTrail trail{axis_.nodes[static_cast<std::size_t>(node)].part, {}};
        while (left_at(node) > 0) {
            const std::size_t n = next_edge(node, trail.way);
            used_[n] = true;
            const std::vector<Vec3> on = way_from(n, node);
            trail.way.insert(trail.way.end(), on.begin() + (trail.way.empty() ? 0 : 1), on.end());
            const AxisEdge& edge = axis_.edges[n];
            node = edge.from == node ? edge.to : edge.from;
        }
        trails_.push_back(std::move(trail));
    }

    const MedialAxis& axis_;
    std::vector<std::vector<std::size_t>> edges_at_;
    std::vector<bool> used_;
    std::vector<AxisTrail> trails_;
};

} // namespace

std::vector<AxisTrail> axis_trails(const MedialAxis& axis) {
    return TrailWalk(axis).run();
}

} // namespace millwright::plot::internal
