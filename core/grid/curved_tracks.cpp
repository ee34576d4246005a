#include "core/grid/curved_tracks.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/internal/outline.h"
#include "core/grid/internal/parallel_nodes.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace millwright::grid {

namespace {

/// One track of an array, by the number of its nodes.
struct TrackOf {
    const NodeArray& nodes;
    TrackDirection direction;
    int track;

    [[nodiscard]] int count() const {
        return direction == TrackDirection::along_v ? nodes.columns : nodes.rows;
    }
    [[nodiscard]] int row(int k) const { return direction == TrackDirection::along_v ? track : k; }
    [[nodiscard]] int column(int k) const { return direction == TrackDirection::along_v ? k : track; }
};

/// Where node k may go: a raster around it, itself first.
std::vector<Vec2>
places_on_row(const TrackOf& of, int k, const Vec2& cell, const CurvedTrackSettings& settings) {
    const Vec2 free = freedom(of.nodes, of.row(k), of.column(k), true);
    const bool along_v = of.direction == TrackDirection::along_v;
    const int most_u = exactly_equal(free.x(), 0.0) ? 0
                       : along_v                    ? settings.places_across
                                                    : settings.places_along;
    const int most_v = exactly_equal(free.y(), 0.0) ? 0
                       : along_v                    ? settings.places_along
                                                    : settings.places_across;
    const Vec2 here = of.nodes.at(of.row(k), of.column(k));
    std::vector<Vec2> found{here};
    for (int a = -most_u; a <= most_u; ++a) {
        for (int b = -most_v; b <= most_v; ++b) {
            const Vec2 step(most_u > 0 ? settings.reach * a / most_u : 0.0,
                            most_v > 0 ? settings.reach * b / most_v : 0.0);
            if (a != 0 || b != 0) {
                found.emplace_back((here + step.cwiseProduct(cell)).cwiseMax(0.0).cwiseMin(1.0));
            }
        }
    }
    return found;
}

/// The indices of `values`, the least first.
std::vector<std::size_t> ascending(const std::vector<double>& values) {
    std::vector<std::size_t> order(values.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [&](std::size_t n) { return values[n]; });
    return order;
}

std::vector<Vec2> shortest_track(const PathObjective& objective,
                                 const TrackOf& of,
                                 const CurvedTrackSettings& settings,
                                 const Progress& progress) {
    std::vector<std::vector<Vec2>> places;
    for (int k = 0; k < of.count(); ++k) {
        places.push_back(places_on_row(of, k, objective.cell(), settings));
    }
    std::vector<std::vector<std::size_t>> from;
    std::vector<double> reached(places.front().size());
    for (std::size_t a = 0; a < reached.size(); ++a) {
        reached[a] = objective.of_gaps(of.nodes, of.track, 0, places.front()[a]);
    }
    for (int k = 0; k + 1 < of.count(); ++k) {
        progress.check();
        const std::vector<Vec2>& here = places[static_cast<std::size_t>(k)];
        const std::vector<Vec2>& there = places[static_cast<std::size_t>(k) + 1];
        std::vector<double> next(there.size(), infinity);
        std::vector<std::size_t>& before = from.emplace_back(there.size(), 0);
        const std::vector<std::size_t> cheapest_first = ascending(reached);
        for (std::size_t b = 0; b < there.size(); ++b) {
            const double gaps = objective.of_gaps(of.nodes, of.track, k + 1, there[b]);
            for (const std::size_t a : cheapest_first) {
                if (!(reached[a] < infinity && gaps < infinity)) {
                    break; // and nothing behind it is cheaper
                }
                const double room = next[b] - reached[a] - gaps;
                if (!(room > 0.0)) {
                    break;
                }
                const double sum =
                    reached[a] + gaps + objective.of_move(of.nodes, of.track, k, here[a], there[b], room);
                if (sum < next[b]) {
                    next[b] = sum;
                    before[b] = a;
                }
            }
        }
        reached = std::move(next);
    }
    auto at = static_cast<std::size_t>(std::ranges::min_element(reached) - reached.begin());
    std::vector<Vec2> found(places.size());
    for (std::size_t k = places.size(); k-- > 0;) {
        found[k] = places[k][at];
        at = k > 0 ? from[k - 1][at] : at;
    }
    return found;
}

} // namespace

NodeArray shortest_curved_tracks(const PathObjective& objective,
                                 NodeArray nodes,
                                 const CurvedTrackSettings& settings,
                                 const Progress& progress) {
    const TrackDirection direction = objective.direction();
    const int tracks = direction == TrackDirection::along_v ? nodes.rows : nodes.columns;
    for (const int first : {0, 1}) {
        NodeArray moved = nodes;
        const int count = (tracks - first + 1) / 2;
        each_track(count, progress.part(0.5 * first, 0.5 * (first + 1)), [&](std::size_t n) {
            const TrackOf of{nodes, direction, first + 2 * static_cast<int>(n)};
            const std::vector<Vec2> found = shortest_track(objective, of, settings, progress);
            for (int k = 0; k < of.count(); ++k) {
                moved.at(of.row(k), of.column(k)) = found[static_cast<std::size_t>(k)];
            }
        });
        nodes = std::move(moved);
    }
    return nodes;
}

} // namespace millwright::grid
