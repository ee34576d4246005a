// The promise that no grid is handed out that is worse than the one it started from.
#pragma once

#include "core/base/progress.h"
#include "core/grid/error_model.h"
#include "core/grid/track.h"

#include <optional>
#include <vector>

namespace millwright::grid {

// Above the start's figures, and still no worse: what rounding makes of moves that are in both grids.
inline constexpr double negligible_mm =
    1e-6; ///< a nanometre: rounding on a part of a metre is a tenth of that
inline constexpr double negligible_rad = 1e-8; ///< a nanometre at 100 mm

/// What the start is worth: its path as it is run (ErrorModel::on_path), and each of its moves individually.
/// Judged finely.
class QualityGuard {
public:
    /// `model` must outlive this. Throws Cancelled.
    QualityGuard(const ErrorModel& model,
                 const Grid& start,
                 TrackDirection direction,
                 const Progress& progress);

    /// The figures of the path over `grid` if its mean, max and largest axis deviation are not above the
    /// start's (by what is not negligible) and its moves have a lower mean; else nothing. Throws Cancelled.
    [[nodiscard]] std::optional<ErrorSummary> kept_by(const Grid& grid, const Progress& progress) const;

private:
    const ErrorModel& model_;
    TrackDirection direction_;
    double mean_of_moves_;
    ErrorSummary path_;
};

// Keeps the promise that no grid is reported worse than the start: of the versions of each track the best one
// is taken with which none of the figures rises. Judged with fine sampling.

/// A track with its moves.
struct MeasuredTrack {
    PlacedTrack placed;
    std::vector<MoveError> moves;
};

/// Parallel over tracks. Throws Cancelled within one move.
[[nodiscard]] std::vector<MeasuredTrack> measured(const ErrorModel& model,
                                                  const std::vector<PlacedTrack>& tracks,
                                                  Sampling sampling,
                                                  const Progress& progress);

/// All moves, track by track.
[[nodiscard]] std::vector<MoveError> moves_of(const std::vector<MeasuredTrack>& tracks);

/// What no move and no pair of neighbours may exceed.
struct TrackQualityLimits {
    double tip = 0.0;  ///< largest tip error of the start grid, mm
    double axis = 0.0; ///< largest axis deviation of the start grid, rad
    double gap = 0.0;  ///< largest distance between neighbouring tracks that is allowed, mm
};

/// The promise that `start` makes, its track gap allowed to grow by the share `gap_allowance`.
[[nodiscard]] TrackQualityLimits quality_limits_of(const ErrorModel& model,
                                                   const std::vector<MeasuredTrack>& start,
                                                   double gap_allowance,
                                                   const Progress& progress);

struct GuardedTracks {
    std::vector<MeasuredTrack> tracks;
    int kept_from_start = 0; ///< tracks of which no version kept the promise
};

/// Of each track the first of `versions` (each a whole grid of tracks, the most wanted first) in reach with
/// which the promise is kept and max, mean and length-weighted mean of tip, off_surface and param (MoveError)
/// do not rise: over the whole grid if that is so at once, else track by track, where at last the start's own
/// track is taken. Where two neighbours lie too far apart, both go back to their next version until the gap
/// is kept.
[[nodiscard]] GuardedTracks never_worse(const ErrorModel& model,
                                        const std::vector<std::vector<MeasuredTrack>>& versions,
                                        const std::vector<MeasuredTrack>& start,
                                        const TrackQualityLimits& limits,
                                        const Progress& progress);

} // namespace millwright::grid
