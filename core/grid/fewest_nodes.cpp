#include "core/grid/fewest_nodes.h"

#include "core/base/error.h"
#include "core/grid/lattice.h"
#include "core/grid/track_path.h"

#include <algorithm>
#include <utility>

namespace millwright::grid {

namespace {

// The search's sampling misses the top of a move by little: where a move slips through, all are held to less.
constexpr double tightening = 0.99;
constexpr int most_tightenings = 20;

bool all_inside(const ErrorModel& model,
                const PlacedTrack& found,
                const MoveLimits& limits,
                const Progress& progress) {
    for (std::size_t n = 1; n < found.places.size(); ++n) {
        progress.check();
        const Vec2 from = found.track.at(found.places[n - 1]);
        const Vec2 to = found.track.at(found.places[n]);
        if (!limits.allow(model.move(from, to, fine))) {
            return false;
        }
    }
    return true;
}

/// The fewest on the places of `table`.
std::optional<PlacedTrack> fewest_in(const MoveTable& table,
                                     const ErrorModel& model,
                                     const Track& track,
                                     const MoveLimits& limits,
                                     const Progress& progress) {
    MoveLimits held = limits;
    for (int n = 0; n < most_tightenings; ++n) {
        const auto path = shortest_path(table, {}, held);
        if (!path) {
            return std::nullopt;
        }
        PlacedTrack found{track, places_of(table, *path)};
        if (all_inside(model, found, limits, progress)) {
            return found;
        }
        held = {held.tip * tightening, held.axis * tightening};
    }
    return std::nullopt;
}

/// Which moves between `places` are next to one of the coarser table that is nearly inside the limits.
class NextToAllowed {
public:
    NextToAllowed(const MoveTable& rough, const std::vector<double>& places, const MoveLimits& limits)
        : rough_(rough), nearly_{nearly_inside * limits.tip, nearly_inside * limits.axis} {
        const std::vector<double>& ruler = rough.places();
        for (const double place : places) {
            const auto after = std::ranges::upper_bound(ruler, place);
            below_.push_back(
                std::clamp(static_cast<int>(after - ruler.begin()) - 1, 0, std::max(0, rough.size() - 2)));
        }
    }

    [[nodiscard]] bool operator()(int k, int l) const {
        const int from = below_[static_cast<std::size_t>(k)];
        const int to = below_[static_cast<std::size_t>(l)];
        if (to - from <= 1) {
            return true;
        }
        const auto allowed = [this](int a, int b) { return nearly_.allow(rough_.move(a, b)); };
        return allowed(from, to) || allowed(from + 1, to) || allowed(from, to + 1) ||
               allowed(from + 1, to + 1);
    }

private:
    static constexpr double nearly_inside = 4.0;

    const MoveTable& rough_;
    MoveLimits nearly_;
    std::vector<int> below_; ///< the place of the coarser table at or before each place
};

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
    const PlacedTrack ends{track, {first, last}};
    if (all_inside(model, ends, limits, progress)) {
        return ends;
    }
    const auto places_at = [&](int intervals) {
        return lattice(
            model, ends, {.intervals = intervals, .monitor_share = settings.monitor_share}, progress);
    };
    constexpr MoveWindow any_length{0.0, infinity};
    const MoveTable rough(model, track, places_at(settings.lattice / 4), any_length, coarse, progress);
    std::vector<double> places = places_at(settings.lattice);
    const WorthMeasuring worth = NextToAllowed(rough, places, limits);
    const MoveTable table(model, track, std::move(places), any_length, coarse, progress, worth);
    return fewest_in(table, model, track, limits, progress);
}

} // namespace millwright::grid
