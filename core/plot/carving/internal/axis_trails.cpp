#include "core/plot/carving/internal/axis_trails.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

namespace millwright::plot::internal {
namespace {

/// Takes edges away from the axis, trail by trail.
class TrailWalk {
public:
    explicit TrailWalk(const MedialAxis& axis) : axis_(axis), edges_at_(axis.nodes.size()) {
        for (std::size_t n = 0; n < axis.edges.size(); ++n) {
            const AxisEdge& edge = axis.edges[n];
            const std::vector<Vec3>& way = edge.way;
            at(edge.from).insert({turn_of(way[1] - way[0]), n});
            at(edge.to).insert({turn_of(way[way.size() - 2] - way.back()), n});
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
    /// Direction of an edge that begins at a node, rad, and the number of the edge.
    using EdgeFrom = std::pair<double, std::size_t>;

    std::set<EdgeFrom>& at(int node) { return edges_at_[static_cast<std::size_t>(node)]; }
    [[nodiscard]] std::size_t left_at(int node) const {
        return edges_at_[static_cast<std::size_t>(node)].size();
    }

    [[nodiscard]] static double turn_of(const Vec3& along) { return std::atan2(along.y(), along.x()); }

    void take(std::size_t n) {
        const AxisEdge& edge = axis_.edges[n];
        const std::vector<Vec3>& way = edge.way;
        at(edge.from).erase({turn_of(way[1] - way[0]), n});
        at(edge.to).erase({turn_of(way[way.size() - 2] - way.back()), n});
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
        const std::set<EdgeFrom>& edges = at(node);
        if (way.size() < 2) {
            return std::ranges::min_element(edges, {}, &EdgeFrom::second)->second;
        }
        const double ahead = turn_of(way.back() - way[way.size() - 2]);
        auto after = edges.lower_bound({ahead, 0});
        auto before = after == edges.begin() ? std::prev(edges.end()) : std::prev(after);
        after = after == edges.end() ? edges.begin() : after;
        const auto off = [&](const EdgeFrom& edge) {
            return std::abs(std::remainder(edge.first - ahead, 2.0 * std::numbers::pi));
        };
        return off(*before) < off(*after) ? before->second : after->second;
    }

    void walk(int node) {
        AxisTrail trail{axis_.nodes[static_cast<std::size_t>(node)].part, {}};
        while (left_at(node) > 0) {
            const std::size_t n = next_edge(node, trail.way);
            take(n);
            const std::vector<Vec3> on = way_from(n, node);
            trail.way.insert(trail.way.end(), on.begin() + (trail.way.empty() ? 0 : 1), on.end());
            const AxisEdge& edge = axis_.edges[n];
            node = edge.from == node ? edge.to : edge.from;
        }
        trails_.push_back(std::move(trail));
    }

    const MedialAxis& axis_;
    std::vector<std::set<EdgeFrom>> edges_at_; ///< those that are left
    std::vector<AxisTrail> trails_;
};

} // namespace

std::vector<AxisTrail> axis_trails(const MedialAxis& axis) {
    return TrailWalk(axis).run();
}

} // namespace millwright::plot::internal
