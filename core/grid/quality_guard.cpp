#include "core/grid/quality_guard.h"

#include "core/base/error.h"
#include "core/base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::grid {

namespace {

double
mean_of_moves(const ErrorModel& model, const Grid& grid, TrackDirection direction, const Progress& progress) {
    return summary(measure(model, grid, direction, fine, progress)).mean;
}

} // namespace

QualityGuard::QualityGuard(const ErrorModel& model,
                           const Grid& start,
                           TrackDirection direction,
                           const Progress& progress)
    : model_(model), direction_(direction), mean_of_moves_(mean_of_moves(model, start, direction, progress)),
      path_(model.on_path(start, direction, progress)) {}

std::optional<ErrorSummary> QualityGuard::kept_by(const Grid& grid, const Progress& progress) const {
    const ErrorSummary path = model_.on_path(grid, direction_, progress);
    const bool path_is_kept = path.mean <= path_.mean + negligible_mm &&
                              path.max <= path_.max + negligible_mm &&
                              path.axis_max <= path_.axis_max + negligible_rad;
    if (path_is_kept && mean_of_moves(model_, grid, direction_, progress) < mean_of_moves_) {
        return path;
    }
    return std::nullopt;
}

namespace {

using Tracks = std::vector<MeasuredTrack>;

constexpr std::array quantities{&MoveError::tip, &MoveError::off_surface, &MoveError::param};

/// Whether a version has to be better on its own, or is only one part of a better grid.
enum class Judging { by_limits, by_itself };

ErrorSummary summary_of(const std::vector<MoveError>& moves, double MoveError::*quantity) {
    std::vector<MoveError> chosen;
    for (const MoveError& move : moves) {
        chosen.push_back({move.*quantity, move.axis, move.length});
    }
    return summary(chosen);
}

bool not_above(const std::vector<MoveError>& is, const std::vector<MoveError>& was) {
    return std::ranges::all_of(quantities, [&](double MoveError::*quantity) {
        const ErrorSummary now = summary_of(is, quantity);
        const ErrorSummary before = summary_of(was, quantity);
        return now.max <= before.max + negligible_mm && now.mean <= before.mean + negligible_mm &&
               now.lmean <= before.lmean + negligible_mm;
    });
}

bool keeps_limits(const TrackQualityLimits& limits, const MeasuredTrack& track) {
    return std::ranges::all_of(track.moves, [&](const MoveError& move) {
        const bool in_reach = std::isfinite(move.tip) && std::isfinite(move.axis); // the start may not be
        return in_reach && move.tip <= limits.tip + negligible_mm &&
               move.axis <= limits.axis + negligible_rad;
    });
}

double gap_between(const ErrorModel& model, const PlacedTrack& a, const PlacedTrack& b) {
    return model.track_gap(Grid(array_of({a, b})), a.track.direction);
}

/// One track's choice: the first of its candidates that is still allowed, the start last.
struct Choice {
    std::vector<const MeasuredTrack*> candidates;
    std::size_t chosen = 0;

    [[nodiscard]] const MeasuredTrack& track() const { return *candidates[chosen]; }
    [[nodiscard]] bool is_start() const { return chosen + 1 == candidates.size(); }
    void step_back() { chosen = std::min(chosen + 1, candidates.size() - 1); }
};

std::vector<Choice> choices(const std::vector<Tracks>& versions,
                            const Tracks& start,
                            const TrackQualityLimits& limits,
                            Judging judging) {
    std::vector<Choice> found(start.size());
    for (std::size_t t = 0; t < start.size(); ++t) {
        for (const Tracks& version : versions) {
            const bool good = judging == Judging::by_limits || not_above(version[t].moves, start[t].moves);
            if (good && keeps_limits(limits, version[t])) {
                found[t].candidates.push_back(&version[t]);
            }
        }
        found[t].candidates.push_back(&start[t]);
    }
    return found;
}

/// Steps back the tracks of every pair that is too far apart; true if any pair was.
bool close_gaps(const ErrorModel& model,
                std::vector<Choice>& tracks,
                double widest,
                const Progress& progress) {
    bool changed = false;
    for (std::size_t t = 0; t + 1 < tracks.size(); ++t) {
        progress.check();
        Choice& a = tracks[t];
        Choice& b = tracks[t + 1];
        const bool movable = !a.is_start() || !b.is_start();
        if (movable && gap_between(model, a.track().placed, b.track().placed) > widest) {
            a.step_back();
            b.step_back();
            changed = true;
        }
    }
    return changed;
}

GuardedTracks
taken(const ErrorModel& model, std::vector<Choice> tracks, double widest, const Progress& progress) {
    while (close_gaps(model, tracks, widest, progress)) {
        progress.check();
    }
    GuardedTracks guarded;
    for (const Choice& choice : tracks) {
        guarded.tracks.push_back(choice.track());
        guarded.kept_from_start += choice.is_start() ? 1 : 0;
    }
    return guarded;
}

} // namespace

std::vector<MeasuredTrack> measured(const ErrorModel& model,
                                    const std::vector<PlacedTrack>& tracks,
                                    Sampling sampling,
                                    const Progress& progress) {
    Tracks found(tracks.size());
    parallel_for(std::ssize(tracks), 1, [&](std::ptrdiff_t n) {
        const PlacedTrack& placed = tracks[static_cast<std::size_t>(n)];
        MeasuredTrack& track = found[static_cast<std::size_t>(n)];
        track.placed = placed;
        for (std::size_t k = 0; k + 1 < placed.places.size(); ++k) {
            progress.check();
            const Vec2 from = placed.track.at(placed.places[k]);
            const Vec2 to = placed.track.at(placed.places[k + 1]);
            track.moves.push_back(model.move(from, to, sampling));
        }
    });
    return found;
}

std::vector<MoveError> moves_of(const std::vector<MeasuredTrack>& tracks) {
    std::vector<MoveError> moves;
    for (const MeasuredTrack& track : tracks) {
        moves.insert(moves.end(), track.moves.begin(), track.moves.end());
    }
    return moves;
}

TrackQualityLimits quality_limits_of(const ErrorModel& model,
                                     const std::vector<MeasuredTrack>& start,
                                     double gap_allowance,
                                     const Progress& progress) {
    const ErrorSummary was = summary(moves_of(start));
    double gap = 0.0;
    for (std::size_t t = 0; t + 1 < start.size(); ++t) {
        progress.check();
        gap = std::max(gap, gap_between(model, start[t].placed, start[t + 1].placed));
    }
    return {was.max, was.axis_max, (1.0 + gap_allowance) * gap};
}

GuardedTracks never_worse(const ErrorModel& model,
                          const std::vector<std::vector<MeasuredTrack>>& versions,
                          const std::vector<MeasuredTrack>& start,
                          const TrackQualityLimits& limits,
                          const Progress& progress) {
    const std::vector<MoveError> was = moves_of(start);
    GuardedTracks together =
        taken(model, choices(versions, start, limits, Judging::by_limits), limits.gap, progress);
    if (not_above(moves_of(together.tracks), was)) {
        return together;
    }
    return taken(model, choices(versions, start, limits, Judging::by_itself), limits.gap, progress);
}

} // namespace millwright::grid
