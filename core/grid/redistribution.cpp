#include "core/grid/redistribution.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/grid/internal/parallel_nodes.h"
#include "core/grid/track.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace millwright::grid {

namespace {

constexpr int cells_per_step = 8; // of the monitor; a move of it is half a step long

std::vector<double> smoothed(const std::vector<double>& values) {
    std::vector<double> found(values.size());
    const std::size_t last = values.size() - 1;
    for (std::size_t n = 0; n < values.size(); ++n) {
        found[n] = 0.25 * values[n == 0 ? 0 : n - 1] + 0.5 * values[n] + 0.25 * values[std::min(n + 1, last)];
    }
    return found;
}

PlacedTrack redistributed(const ErrorModel& model,
                          const PlacedTrack& track,
                          const RedistributionSettings& settings,
                          const Progress& progress) {
    const int moves = static_cast<int>(std::ssize(track.places)) - 1;
    std::vector<double> density = step_monitor(model, track, cells_per_step * moves, progress);
    for (int pass = 0; pass < settings.smoothings; ++pass) {
        density = smoothed(density);
    }
    for (double& value : density) {
        value += settings.floor;
    }
    return {track.track, equal_shares(density, track.places.front(), track.places.back(), moves)};
}

} // namespace

std::vector<double>
step_monitor(const ErrorModel& model, const PlacedTrack& track, int cells, const Progress& progress) {
    expects(cells >= 1 && std::ssize(track.places) >= 2, "a monitor has cells on a track");
    const double first = track.places.front();
    const double last = track.places.back();
    std::vector<Vec2> nodes;
    for (int n = 0; n <= cells; ++n) {
        nodes.push_back(track.track.at(mix(first, last, static_cast<double>(n) / cells)));
    }
    const auto moves = model.lattice(nodes, coarse);
    const int reach = std::min(cells, cells_per_step / 2); // cells in one move
    std::vector<double> found;
    for (int n = 0; n < cells; ++n) {
        progress.check();
        const int from = std::clamp(n - reach / 2, 0, cells - reach);
        const double error = moves->between(from, from + reach).tip;
        found.push_back(std::isfinite(error) ? std::sqrt(error) : 0.0);
    }
    const double mean = std::accumulate(found.begin(), found.end(), 0.0) / cells;
    for (double& value : found) {
        value = mean > 0.0 ? value / mean : 1.0;
    }
    return found;
}

Redistribution::Redistribution(const ErrorModel& model,
                               const Grid& start,
                               TrackDirection direction,
                               const RedistributionSettings& settings)
    : model_(model), settings_(settings),
      state_{.current = start.array(), .best = start, .start = {}, .now = {}, .of_best = {}, .note = {}},
      start_(straight_tracks(start, direction)) {
    expects(settings.floor > 0.0 && settings.smoothings >= 0 && settings.gap_allowance >= 0.0,
            "the density floor is positive, and no count or share is negative");
}

bool Redistribution::advance(const Progress& progress) {
    if (state_.status != OptimiserStatus::running) {
        return false;
    }
    progress.report(0.0, "Redistributing the nodes of each track");
    const std::vector<MeasuredTrack> start = measured(model_, start_, fine, progress);
    const TrackQualityLimits limits = quality_limits_of(model_, start, settings_.gap_allowance, progress);
    std::vector<PlacedTrack> placed(start_.size());
    each_track(std::ssize(start_), progress.part(0.2, 0.7), [&](std::size_t t) {
        placed[t] = redistributed(model_, start_[t], settings_, progress);
    });
    const auto found = measured(model_, placed, fine, progress.part(0.7, 1.0));
    const GuardedTracks best = never_worse(model_, {found}, start, limits, progress);
    state_.start = summary(moves_of(start));
    state_.now = state_.of_best = summary(moves_of(best.tracks));
    std::vector<PlacedTrack> tracks;
    for (const MeasuredTrack& track : best.tracks) {
        tracks.push_back(track.placed);
    }
    state_.best = Grid(array_of(tracks));
    state_.current = state_.best.array();
    state_.reached = array_of(placed);
    state_.round = 1;
    state_.done = 1.0;
    const bool gained = best.kept_from_start < static_cast<int>(std::ssize(start_));
    state_.status = gained ? OptimiserStatus::converged : OptimiserStatus::no_gain;
    state_.note = best.kept_from_start == 0 ? "Equal shares of the monitor on every track"
                                            : "Equal shares of the monitor; unchanged tracks: " +
                                                  std::to_string(best.kept_from_start);
    return false;
}

} // namespace millwright::grid
