// The method that cuts the error: the nodes of each track, on their own, where the machine wants them. First
// the best path through a fine lattice by dynamic programming, which is the optimum on that lattice, then a
// polish between its places. Tracks stay straight and where they are: cells cannot fold, and the scallop
// height hardly changes.
#pragma once

#include "core/grid/grid_optimiser.h"
#include "core/grid/quality_guard.h"
#include "core/grid/track.h"
#include "core/grid/track_path.h"

#include <vector>

namespace millwright::grid {

// How the nodes of a track are searched for, and what that search is made of.

/// Shares are 0 to 1. Values outside their range throw Defect when the optimiser is made.
struct TrackSettings {
    // The lattice
    int lattice = 0;             ///< intervals per track, n to 100 000; 0: max(160, 4 n) for n nodes
    double monitor_share = 0.5;  ///< of its density that follows the error, 0 to 0.99
    double longest_move = 4.5;   ///< that is looked at, in mean steps of a track, 1.5 to 100
    double shortest_move = 0.03; ///< the same, 0 to 0.5

    // What a move costs (MoveCost)
    double error_exponent = 2.0;         ///< 1 to 16: the larger, the more the worst moves count
    double tip_share = 0.5;              ///< of the tip's way along the surface, beside that off it
    double param_share = 0.05;           ///< of the distance at equal parameters
    double axis_weight_mm_per_deg = 0.0; ///< error that one degree of axis deviation counts as, 0 to 100
    double length_share = 0.5;           ///< of the weight of a move that is its length

    // What no move shall exceed, as shares of the start's worst move. Where that is not possible, the axis
    // comes first (per track), then the tip inside that (the same for all tracks).
    double worst_share = 0.12;
    double axis_share = 0.8;

    int polish_sweeps = 20;      ///< at most, 0 to 1000
    double gap_allowance = 0.15; ///< share by which the track gap may grow, 0 to 10

    friend bool operator==(const TrackSettings&, const TrackSettings&) = default;
};

/// For live editing: a lattice of 100 intervals (too few for more nodes per track) and no polish. A third of
/// the time, and all but a few per cent of the gain.
[[nodiscard]] TrackSettings quick_track_settings();

/// Throws Defect unless every value is in its range for `nodes` per track; `lattice` 0 becomes a number.
[[nodiscard]] TrackSettings checked(TrackSettings settings, int nodes);

/// What a move costs, where an even one has the length `even_length`, mm.
[[nodiscard]] MoveCost cost_by(const TrackSettings& settings, double even_length);

/// Of the places of `track`.
[[nodiscard]] double mean_step(const PlacedTrack& track);

/// The moves that are looked at for the track of `start`, whose own moves are among them. `settings` are
/// checked. Throws Cancelled.
[[nodiscard]] MoveTable moves_by(const ErrorModel& model,
                                 const PlacedTrack& start,
                                 const TrackSettings& settings,
                                 const Progress& progress);

/// First step: measures the start and the moves of the lattices. Second: the best paths. Then one polishing
/// sweep a step. The figures of `state` are there after the first step; while polishing `now` is by the
/// polish's sampling, all else fine. `best` is above `start` neither in axis_max nor in max, mean and lmean,
/// and its track gap is not above the start's by more than the allowance. `norm` is the longest way of a node
/// in the last sweep, in mean steps of a track.
class TrackOptimiser final : public GridOptimiser {
public:
    /// `model` must outlive the optimiser. Throws Defect if a track of `start` is not straight
    /// (straight_tracks).
    TrackOptimiser(const ErrorModel& model,
                   const Grid& start,
                   TrackDirection direction,
                   const TrackSettings& settings);

    bool advance(const Progress& progress) override;
    [[nodiscard]] const OptimiserState& state() const override { return state_; }

private:
    enum class Stage { lattices, paths, polish, done };

    void measure_lattices(const Progress& progress);
    void find_paths(const Progress& progress);
    void sweep(const Progress& progress);
    void begin_polish();
    void
    end_polish(const std::vector<TrackPolish>& polished, OptimiserStatus status, const Progress& progress);
    void finish(OptimiserStatus status);
    void publish(const GuardedTracks& best);

    [[nodiscard]] std::vector<MoveLimits> aims(const Progress& progress) const;
    [[nodiscard]] PlacedTrack path_of(std::size_t track, const MoveLimits& limits) const;
    [[nodiscard]] MoveCost cost_of(std::size_t track) const;
    [[nodiscard]] int moves() const { return static_cast<int>(std::ssize(start_.front().places)) - 1; }

    const ErrorModel& model_;
    TrackSettings settings_;
    Stage stage_ = Stage::lattices;
    OptimiserState state_;
    std::vector<PlacedTrack> start_;
    std::vector<MeasuredTrack> measured_start_;
    TrackQualityLimits quality_limits_;
    std::vector<MoveTable> tables_;
    std::vector<MoveLimits> limits_; // [track], by the search's sampling
    std::vector<MeasuredTrack> paths_;
    std::vector<TrackPolish> polishes_;
};

} // namespace millwright::grid
