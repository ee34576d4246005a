#include "core/grid/fewest_nodes.h"

#include "core/base/error.h"
#include "core/grid/track.h"
#include "core/grid/track_path.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace millwright::grid {

namespace {

// More chords than `coarse`: the sagitta of one of 16 chords of a long move can exceed the tolerance.
constexpr Sampling screening{10, 64};

MoveLimits scaled(const MoveLimits& limits, double factor) {
    return {factor * limits.tip, factor * limits.axis};
}

/// Which moves between `places` lie next to a move of a coarser lattice that is nearly allowed.
class NextToAllowed {
public:
    NextToAllowed(MoveTable rough, const std::vector<double>& places, const MoveLimits& limits)
        : rough_(std::move(rough)), nearly_(scaled(limits, nearly_allowed)) {
        const std::vector<double>& ruler = rough_.places();
        for (const double place : places) {
            const auto after = std::ranges::upper_bound(ruler, place);
            below_.push_back(std::clamp(static_cast<int>(after - ruler.begin()) - 1, 0, rough_.size() - 2));
        }
    }

    [[nodiscard]] bool operator()(int k, int l) const {
        const int from = below_[static_cast<std::size_t>(k)];
        const int to = below_[static_cast<std::size_t>(l)];
        return to - from <= 1 || allowed(from + 1, to) || allowed(from, to) || allowed(from + 1, to + 1) ||
               allowed(from, to + 1);
    }

private:
    static constexpr double nearly_allowed = 2.0;

    [[nodiscard]] bool allowed(int k, int l) const {
        return l < rough_.end(k) && nearly_.allow(rough_.move(k, l));
    }

    MoveTable rough_;
    MoveLimits nearly_;
    std::vector<int> below_; ///< the place of the coarser lattice at or before each place
};

/// One track and what its moves may not exceed.
struct NodeSearch {
    const ErrorModel& model;
    PlacedTrack ends;
    MoveLimits limits;
    double monitor_share;
    const Progress& progress;

    [[nodiscard]] MoveError finely(double from, double to) const {
        return model.move(ends.track.at(from), ends.track.at(to), fine);
    }
    [[nodiscard]] MoveTable screened(int intervals) const;
    void measure_near_limits(MoveTable& table, const LatticeErrors& fine_errors) const;
    [[nodiscard]] bool
    measure_path(MoveTable& table, const LatticePath& path, const LatticeErrors& fine_errors) const;
};

/// Every move of a lattice of so many intervals that can be allowed, by the sampling of the screening.
MoveTable NodeSearch::screened(int intervals) const {
    constexpr int coarser = 4;
    constexpr int coarsest = 100; // intervals
    std::vector<double> places =
        lattice(model, ends, {.intervals = intervals, .monitor_share = monitor_share}, progress);
    MoveFilter filter;
    if (intervals >= coarser * coarsest) {
        filter = NextToAllowed(screened(intervals / coarser), places, limits);
    }
    constexpr MoveWindow any_length{0.0, infinity};
    return {model, ends.track, std::move(places), any_length, screening, progress, filter};
}

/// Fine sampling decides where the screening may be wrong.
void NodeSearch::measure_near_limits(MoveTable& table, const LatticeErrors& fine_errors) const {
    const MoveLimits surely = scaled(limits, 0.8);
    const MoveLimits perhaps = scaled(limits, 1.25);
    for (int k = 0; k < table.size(); ++k) {
        progress.check();
        for (int l = table.first(k); l < table.end(k); ++l) {
            const MoveError& seen = table.move(k, l);
            if (perhaps.allow(seen) && !surely.allow(seen)) {
                table.replace(k, l, fine_errors.between(k, l));
            }
        }
    }
}

/// Whether the moves of the path are all allowed. Where one is not, all moves from its first place are
/// measured finely, so that the path does not come back by the place next to it.
bool NodeSearch::measure_path(MoveTable& table,
                              const LatticePath& path,
                              const LatticeErrors& fine_errors) const {
    const std::vector<double> places = places_of(table, path);
    bool all_allowed = true;
    for (std::size_t n = 1; n < places.size(); ++n) {
        progress.check();
        const MoveError seen = finely(places[n - 1], places[n]);
        if (limits.allow(seen)) {
            continue;
        }
        all_allowed = false;
        const int k = path.nodes[n - 1];
        for (int l = table.first(k); l < table.end(k); ++l) {
            if (limits.allow(table.move(k, l))) {
                table.replace(k, l, fine_errors.between(k, l));
            }
        }
        table.replace(k, path.nodes[n], seen);
    }
    return all_allowed;
}

} // namespace

std::optional<PlacedTrack> fewest_nodes(const ErrorModel& model,
                                        const Track& track,
                                        double first,
                                        double last,
                                        const MoveLimits& limits,
                                        const FewestNodesSettings& settings,
                                        const Progress& progress) {
    expects(first < last, "a track has a length");
    expects(settings.lattice >= 8 && settings.lattice <= 100'000, "a lattice has 8 to 100 000 intervals");
    const NodeSearch search{model, {track, {first, last}}, limits, settings.monitor_share, progress};
    if (limits.allow(search.finely(first, last))) {
        return search.ends;
    }
    MoveTable table = search.screened(settings.lattice);
    std::vector<Vec2> nodes;
    for (const double place : table.places()) {
        nodes.push_back(track.at(place));
    }
    const auto fine_errors = model.lattice(nodes, fine);
    search.measure_near_limits(table, *fine_errors);
    while (const auto path = shortest_path(table, {}, limits)) {
        if (search.measure_path(table, *path, *fine_errors)) {
            return PlacedTrack{track, places_of(table, *path)};
        }
    }
    return std::nullopt;
}

} // namespace millwright::grid
