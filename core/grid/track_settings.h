// How the nodes of a track are searched for, and what that search is made of.
#pragma once

#include "core/grid/move_cost.h"
#include "core/grid/track.h"
#include "core/grid/track_path.h"

namespace millwright::grid {

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

} // namespace millwright::grid
