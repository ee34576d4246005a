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

/// On a lattice of so many intervals, with moves up to `longest`.
std::optional<PlacedTrack> fewest_on(const ErrorModel& model,
                                     const PlacedTrack& ends,
                                     const LatticeSettings& fineness,
                                     double longest,
                                     const MoveLimits& limits,
                                     const Progress& progress) {
    const MoveTable table(
        model, ends.track, lattice(model, ends, fineness, progress), {0.0, longest}, coarse, progress);
    MoveLimits held = limits;
    for (int n = 0; n < most_tightenings; ++n) {
        const auto path = shortest_path(table, {}, held);
        if (!path) {
            return std::nullopt;
        }
        PlacedTrack found{ends.track, places_of(table, *path)};
        if (all_inside(model, found, limits, progress)) {
            return found;
        }
        held = {held.tip * tightening, held.axis * tightening};
    }
    return std::nullopt;
}

double longest_move(const PlacedTrack& track) {
    double longest = 0.0;
    for (std::size_t n = 1; n < track.places.size(); ++n) {
        longest = std::max(longest, track.places[n] - track.places[n - 1]);
    }
    return longest;
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
    expects(settings.longest_move > 0.0 && settings.longest_move <= 1.0, "a move is a share of its track");
    const PlacedTrack ends{track, {first, last}};
    const double longest = settings.longest_move * (last - first);
    LatticeSettings fineness{.intervals = settings.lattice / 4, .monitor_share = settings.monitor_share};
    const auto roughly = fewest_on(model, ends, fineness, longest, limits, progress);
    fineness.intervals = settings.lattice;
    constexpr double as_long_again = 1.5;
    const double worth_measuring = roughly ? as_long_again * longest_move(*roughly) : longest;
    return fewest_on(model, ends, fineness, std::min(longest, worth_measuring), limits, progress);
}

} // namespace millwright::grid
