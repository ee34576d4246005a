#include "core/grid/track_candidates.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/internal/parallel_nodes.h"
#include "core/grid/track_path.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace millwright::grid {

std::optional<std::vector<int>>
cheapest_choice(std::span<const double> costs, int count, int nearest, int furthest) {
    expects(count >= 2 && nearest >= 1 && nearest <= furthest, "two tracks or more, at positive distances");
    const int size = static_cast<int>(std::ssize(costs));
    std::vector<double> reached(costs.size(), infinity);
    std::vector<std::vector<int>> from; // [choices before, candidate]
    if (size > 0) {
        reached[0] = costs[0];
    }
    for (int chosen = 1; chosen < count; ++chosen) {
        std::vector<double> next(costs.size(), infinity);
        std::vector<int>& before = from.emplace_back(costs.size(), -1);
        for (int to = nearest; to < size; ++to) {
            const auto n = static_cast<std::size_t>(to);
            for (int step = nearest; step <= std::min(furthest, to); ++step) {
                const double sum = reached[static_cast<std::size_t>(to - step)] + costs[n];
                if (sum < next[n]) {
                    next[n] = sum;
                    before[n] = to - step;
                }
            }
        }
        reached = std::move(next);
    }
    if (size == 0 || !(reached.back() < infinity)) {
        return std::nullopt;
    }
    std::vector<int> found{size - 1};
    for (auto before = from.rbegin(); before != from.rend(); ++before) {
        found.push_back((*before)[static_cast<std::size_t>(found.back())]);
    }
    std::ranges::reverse(found);
    return found;
}

namespace {

constexpr double settled_polish = 1e-4; // mean steps: a sweep that moves no node further has settled

/// Between two tracks, `share` of the way; nodes go along.
PlacedTrack between(const PlacedTrack& a, const PlacedTrack& b, double share) {
    PlacedTrack found{{a.track.direction, mix(a.track.across, b.track.across, share)}, {}};
    for (std::size_t n = 0; n < a.places.size(); ++n) {
        found.places.push_back(mix(a.places[n], b.places[n], share));
    }
    return found;
}

std::vector<PlacedTrack> candidates_of(const std::vector<PlacedTrack>& tracks, int a_gap) {
    std::vector<PlacedTrack> found;
    for (std::size_t t = 0; t + 1 < tracks.size(); ++t) {
        for (int k = 0; k < a_gap; ++k) {
            found.push_back(between(tracks[t], tracks[t + 1], static_cast<double>(k) / a_gap));
        }
    }
    found.push_back(tracks.back());
    return found;
}

/// Moves the nodes of `placed` to their best places, and returns what they cost; infinity if no path is in
/// reach.
double place_best_nodes(const ErrorModel& model,
                        PlacedTrack& placed,
                        const TrackSettings& settings,
                        const Progress& progress) {
    const MoveTable table = moves_by(model, placed, settings, progress);
    const int moves = static_cast<int>(std::ssize(placed.places)) - 1;
    const auto path = cheapest_path(table, moves, cost_by(settings, 1.0), {});
    if (!path) {
        return std::numeric_limits<double>::infinity();
    }
    placed.places = places_of(table, *path);
    return path->value;
}

PlacedTrack polished(const ErrorModel& model,
                     const PlacedTrack& track,
                     const TrackSettings& settings,
                     const Progress& progress) {
    const double step = mean_step(track);
    TrackPolish polish(
        model,
        track,
        {.cost = cost_by(settings, 1.0), .limits = {}, .min_gap = settings.shortest_move * step});
    for (int sweep = 0; sweep < settings.polish_sweeps; ++sweep) {
        if (polish.sweep(progress) < settled_polish * step) {
            break;
        }
    }
    return polish.track();
}

} // namespace

TrackCandidates::TrackCandidates(const ErrorModel& model,
                                 const std::vector<PlacedTrack>& start,
                                 int candidates_per_gap,
                                 const TrackSettings& settings,
                                 const Progress& progress)
    : model_(model), settings_(settings), tracks_(static_cast<int>(std::ssize(start))),
      placed_(candidates_of(start, candidates_per_gap)), costs_(placed_.size()) {
    each_track(std::ssize(placed_), progress, [&](std::size_t c) {
        costs_[c] = place_best_nodes(model_, placed_[c], settings_, progress);
    });
}

std::optional<std::vector<PlacedTrack>>
TrackCandidates::cheapest(int nearest, int furthest, const Progress& progress) const {
    const auto chosen = cheapest_choice(costs_, tracks_, nearest, furthest);
    if (!chosen) {
        return std::nullopt;
    }
    std::vector<PlacedTrack> tracks(chosen->size());
    each_track(tracks_, progress, [&](std::size_t t) {
        const auto c = static_cast<std::size_t>((*chosen)[t]);
        tracks[t] = polished(model_, placed_[c], settings_, progress);
    });
    return tracks;
}

} // namespace millwright::grid
