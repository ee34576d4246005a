// The last few per cent between the places of the lattice: each node in turn tries a step forward and back on
// its track and stays where the cost of its two moves is less. Steps grow where they succeed and shrink where
// not.
#pragma once

#include "core/base/progress.h"
#include "core/grid/error_model.h"
#include "core/grid/move_cost.h"
#include "core/grid/track.h"

#include <vector>

namespace millwright::grid {

struct PolishSettings {
    MoveCost cost = {};
    MoveLimits limits = {};
    double min_gap = 0.0;      ///< no two nodes come nearer, or nearer than they are
    Sampling sampling{16, 16}; ///< 10 times inside a move let the search slip between them
    double first_step = 0.10;  ///< of the smaller gap next to the node
    double growth = 1.3;       ///< of the step after a success
    double shrinking = 0.5;    ///< of the step after a failure both ways
};

/// One track while it is polished. The ends stay, the total cost never rises, and of the two moves at a node
/// the worse one, where it is above a limit, never gets worse in what it exceeds.
class TrackPolish {
public:
    TrackPolish(const ErrorModel& model, PlacedTrack track, const PolishSettings& settings);

    /// Moves every inner node once; returns the longest way that one went. Throws Cancelled with the track
    /// valid but half swept.
    double sweep(const Progress& progress);

    [[nodiscard]] const PlacedTrack& track() const { return track_; }
    /// By the settings' sampling.
    [[nodiscard]] const std::vector<MoveError>& moves() const { return moves_; }

private:
    [[nodiscard]] MoveError move(double from, double to) const;
    bool try_place(std::size_t node, double place);

    const ErrorModel& model_;
    PolishSettings settings_;
    PlacedTrack track_;
    std::vector<MoveError> moves_; // [node]: from this node to the next
    std::vector<double> steps_;    // [node]
};

} // namespace millwright::grid
