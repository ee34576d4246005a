// Places where a track may lie, each with the best nodes there, and the choice of tracks among them.
#pragma once

#include "core/grid/track_settings.h"

#include <optional>
#include <vector>

namespace millwright::grid {

/// Candidates lie evenly between neighbours of a start's tracks, which are among them.
class TrackCandidates {
public:
    /// The best nodes of each on its lattice, by the cost of `settings` (checked), in parallel; the nodes
    /// between the start's where no path is in reach. `model` must outlive this. Throws Cancelled.
    TrackCandidates(const ErrorModel& model,
                    const std::vector<PlacedTrack>& start,
                    int candidates_per_gap,
                    const TrackSettings& settings,
                    const Progress& progress);

    /// As many tracks as the start has, `nearest` to `furthest` candidates apart, whose costs are least in
    /// sum, each polished; nothing if no choice is of finite cost. Throws Cancelled.
    [[nodiscard]] std::optional<std::vector<PlacedTrack>>
    cheapest(int nearest, int furthest, const Progress& progress) const;

private:
    const ErrorModel& model_;
    TrackSettings settings_;
    int tracks_;
    std::vector<PlacedTrack> placed_;
    std::vector<double> costs_;
};

} // namespace millwright::grid
