#include "core/plot/carving/medial_axis.h"

#include "core/base/error.h"
#include "core/plot/carving/internal/outline_segments.h"
#include "core/plot/carving/internal/voronoi_edges.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace millwright::plot {
namespace {

void check_axis_settings(const AxisSettings& settings) {
    const bool usable = settings.sampling > 0.0 && settings.pruning >= 0.0;
    if (!usable || !std::isfinite(settings.sampling + settings.pruning)) {
        throw Error(
            fmt::format("a medial axis to {} mm, pruned to {} mm", settings.sampling, settings.pruning));
    }
}

/// Which things belong together, by what connects two of them.
class Groups {
public:
    explicit Groups(std::size_t count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }

    [[nodiscard]] int first(int thing) {
        while (at(thing) != thing) {
            at(thing) = at(at(thing));
            thing = at(thing);
        }
        return thing;
    }
    void connect(int one, int other) {
        at(std::max(first(one), first(other))) = std::min(first(one), first(other));
    }

private:
    [[nodiscard]] int& at(int thing) { return of_[static_cast<std::size_t>(thing)]; }
    std::vector<int> of_;
};

double way_length(const std::vector<Vec3>& way) {
    double length = 0.0;
    for (std::size_t n = 1; n < way.size(); ++n) {
        length += (way[n] - way[n - 1]).head<2>().norm();
    }
    return length;
}

void add_nodes(MedialAxis& axis, const std::vector<internal::VoronoiEdge>& edges) {
    for (const internal::VoronoiEdge& edge : edges) {
        const auto count = static_cast<std::size_t>(std::max(edge.from, edge.to)) + 1;
        axis.nodes.resize(std::max(axis.nodes.size(), count));
        for (const auto& [node, at] :
             {std::pair(edge.from, edge.way.front()), std::pair(edge.to, edge.way.back())}) {
            AxisNode& found = axis.nodes[static_cast<std::size_t>(node)];
            found.at = at.head<2>();
            found.clearance = at.z();
        }
    }
}

/// What is connected inside is one part; outlines that touch at a corner are as well.
void number_parts(MedialAxis& axis, const std::vector<internal::VoronoiEdge>& edges) {
    const int nodes = static_cast<int>(axis.nodes.size());
    Groups groups(axis.nodes.size() + axis.region.size());
    for (const internal::VoronoiEdge& edge : edges) {
        for (const int other : {edge.to, nodes + edge.ring, nodes + edge.other_ring}) {
            groups.connect(edge.from, other);
        }
    }
    std::map<int, int> numbers;
    const auto part_of = [&](int thing) {
        return numbers.emplace(groups.first(thing), static_cast<int>(numbers.size())).first->second;
    };
    for (int n = 0; n < nodes; ++n) {
        axis.nodes[static_cast<std::size_t>(n)].part = part_of(n);
    }
    for (std::size_t n = 0; n < axis.region.size(); ++n) {
        axis.ring_parts.push_back(part_of(nodes + static_cast<int>(n)));
    }
    axis.parts = static_cast<int>(numbers.size());
}

/// Takes branches away from their ends as long as what they reach is reached without them.
class Pruning {
public:
    Pruning(MedialAxis& axis, double tolerance)
        : axis_(axis), tolerance_(tolerance), edges_at_(axis.nodes.size()), kept_(axis.edges.size(), true) {
        for (std::size_t n = 0; n < axis.edges.size(); ++n) {
            at(axis.edges[n].from).add(n);
            at(axis.edges[n].to).add(n);
        }
        for (const AxisNode& node : axis.nodes) {
            reach_.push_back(node.clearance);
        }
    }

    void run() {
        std::vector<int> ends;
        for (int n = 0; n < static_cast<int>(axis_.nodes.size()); ++n) {
            ends.push_back(n);
        }
        while (!ends.empty()) {
            std::vector<int> next;
            for (const int end : ends) {
                if (const int behind = cut_off(end); behind >= 0) {
                    next.push_back(behind);
                }
            }
            ends = std::move(next);
        }
        std::size_t n = 0;
        std::erase_if(axis_.edges, [&](const AxisEdge&) { return !kept_[n++]; });
    }

private:
    /// Edges at a node. Their numbers are combined, so that the last one left is known without a search.
    struct EdgesLeft {
        std::size_t count = 0;
        std::size_t combined = 0;

        void add(std::size_t edge) {
            ++count;
            combined ^= edge;
        }
        void remove(std::size_t edge) {
            --count;
            combined ^= edge;
        }
    };

    EdgesLeft& at(int node) { return edges_at_[static_cast<std::size_t>(node)]; }
    double& reach(int node) { return reach_[static_cast<std::size_t>(node)]; }

    /// The node behind the branch that ends at `end`, if it was taken away; else -1.
    int cut_off(int end) {
        if (at(end).count != 1) {
            return -1;
        }
        const std::size_t n = at(end).combined;
        const AxisEdge& edge = axis_.edges[n];
        const int behind = edge.from == end ? edge.to : edge.from;
        // Along the branch a disc reaches no farther than this from the node behind it.
        const double reached = reach(end) + way_length(edge.way);
        if (behind == end || reached - axis_.nodes[static_cast<std::size_t>(behind)].clearance > tolerance_) {
            return -1;
        }
        reach(behind) = std::max(reach(behind), reached);
        kept_[n] = false;
        at(end).remove(n);
        at(behind).remove(n);
        return behind;
    }

    MedialAxis& axis_;
    double tolerance_;
    std::vector<EdgesLeft> edges_at_;
    std::vector<bool> kept_;
    std::vector<double> reach_; ///< from each node, of discs at it and on what was taken away behind it
};

/// Nodes that no edge reaches go, but for the one that was left of a part.
void drop_bare_nodes(MedialAxis& axis) {
    constexpr int none = -1;
    std::vector<int> widest(static_cast<std::size_t>(axis.parts), none);
    std::vector<bool> reached(axis.nodes.size(), false);
    std::vector<bool> branches(static_cast<std::size_t>(axis.parts), false);
    for (const AxisEdge& edge : axis.edges) {
        for (const int node : {edge.from, edge.to}) {
            reached[static_cast<std::size_t>(node)] = true;
            branches[static_cast<std::size_t>(axis.nodes[static_cast<std::size_t>(node)].part)] = true;
        }
    }
    for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
        int& best = widest[static_cast<std::size_t>(axis.nodes[n].part)];
        if (best == none || axis.nodes[n].clearance > axis.nodes[static_cast<std::size_t>(best)].clearance) {
            best = static_cast<int>(n);
        }
    }
    std::vector<int> numbers(axis.nodes.size(), none);
    std::vector<AxisNode> nodes;
    for (std::size_t n = 0; n < axis.nodes.size(); ++n) {
        const auto part = static_cast<std::size_t>(axis.nodes[n].part);
        if (reached[n] || (!branches[part] && widest[part] == static_cast<int>(n))) {
            numbers[n] = static_cast<int>(nodes.size());
            nodes.push_back(axis.nodes[n]);
        }
    }
    axis.nodes = std::move(nodes);
    for (AxisEdge& edge : axis.edges) {
        edge.from = numbers[static_cast<std::size_t>(edge.from)];
        edge.to = numbers[static_cast<std::size_t>(edge.to)];
    }
}

} // namespace

MedialAxis medial_axis(const Region& drawn, const AxisSettings& settings, const Progress& progress) {
    check_axis_settings(settings);
    const internal::OutlineSegments outlines =
        internal::outline_segments(drawn, settings.sampling, progress.part(0.0, 0.4));
    progress.report(0.4);
    MedialAxis axis;
    axis.region = outlines.rings;
    axis.crossings = outlines.crossings;
    axis.flat = outlines.flat;
    axis.repeated = outlines.repeated;
    if (outlines.segments.empty()) {
        return axis;
    }
    std::vector<internal::VoronoiEdge> edges = internal::voronoi_edges(outlines, settings.sampling, progress);
    progress.report(0.9);
    add_nodes(axis, edges);
    number_parts(axis, edges);
    for (internal::VoronoiEdge& edge : edges) {
        axis.edges.push_back({edge.from, edge.to, std::move(edge.way)});
    }
    Pruning(axis, settings.pruning).run();
    drop_bare_nodes(axis);
    progress.report(1.0);
    return axis;
}

} // namespace millwright::plot
